//! How work is run: threads, memory ceiling, progress, cancellation.
//!
//! Nothing in this crate touches a process-wide pool. A [`Context`] owns its
//! threads and is kept warm by whoever made it: a freshly started thread gains
//! nothing on a job of a millisecond.

use super::{Error, ErrorKind, Result};
use rayon::ThreadPool;
use rayon::prelude::*;
use std::fmt;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;

/// Chunks per thread: enough to even out uneven work, few enough to be free.
const CHUNKS_PER_THREAD: usize = 8;
/// Elements below which a chunk is not split further.
const SMALLEST_CHUNK: usize = 2048;
/// The most threads of a context.
pub(crate) const MOST_THREADS: usize = 1024;

type Progress = Box<dyn Fn(f64) -> bool + Send + Sync>;

/// A flag that any thread may set to stop work in progress.
#[derive(Debug, Clone, Default)]
pub struct CancelFlag(Arc<AtomicBool>);

impl CancelFlag {
    /// Asks for a stop; the running call returns [`ErrorKind::Cancelled`] soon.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Takes the request back, so that the context can be used again.
    pub fn reset(&self) {
        self.0.store(false, Ordering::Relaxed);
    }

    /// True once a stop was asked for.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Threads that are gone when the value is: rayon itself only asks them to end,
/// and a plug-in may be unloaded from under one that has not.
struct Pool {
    /// `None` only while the value is dropped.
    pool: Option<ThreadPool>,
    threads: Vec<JoinHandle<()>>,
}

impl Pool {
    fn start(n: usize) -> Result<Self> {
        let mut threads = Vec::new();
        let started = rayon::ThreadPoolBuilder::new()
            .num_threads(n)
            .spawn_handler(|worker| {
                let name = format!("carvel-{}", worker.index());
                threads.push(std::thread::Builder::new().name(name).spawn(|| worker.run())?);
                Ok(())
            })
            .build();
        let refused = started.as_ref().err().map(ToString::to_string);
        let pool = Self { pool: started.ok(), threads };
        refused.map_or(Ok(pool), |text| Err(Error::new(ErrorKind::OutOfResources, text)))
    }
}

impl Drop for Pool {
    fn drop(&mut self) {
        drop(self.pool.take());
        for thread in self.threads.drain(..) {
            // One that panicked has ended as well.
            let _ = thread.join();
        }
    }
}

/// Threads, limits and callbacks for a call. Results never depend on it.
pub struct Context {
    pool: Option<Pool>,
    ceiling: Option<u64>,
    progress: Option<Progress>,
    cancel: CancelFlag,
    chunk: Option<usize>,
}

impl Context {
    /// The calling thread only; no ceiling, no callback.
    pub fn serial() -> Self {
        Self {
            pool: None,
            ceiling: None,
            progress: None,
            cancel: CancelFlag::default(),
            chunk: None,
        }
    }

    /// A context with options.
    pub fn builder() -> ContextBuilder {
        ContextBuilder { threads: 1, context: Self::serial() }
    }

    fn pool(&self) -> Option<&ThreadPool> {
        self.pool.as_ref().and_then(|pool| pool.pool.as_ref())
    }

    /// The number of threads that work is spread over.
    pub fn threads(&self) -> usize {
        self.pool().map_or(1, ThreadPool::current_num_threads)
    }

    /// The flag that stops work in this context.
    pub fn cancel_flag(&self) -> CancelFlag {
        self.cancel.clone()
    }

    /// Asks for a stop, as [`CancelFlag::cancel`] does.
    pub fn cancel(&self) {
        self.cancel.cancel();
    }

    /// True once a stop was asked for and not taken back.
    pub fn is_cancelled(&self) -> bool {
        self.cancel.is_cancelled()
    }

    /// Takes a request to stop back, as [`CancelFlag::reset`] does.
    pub fn reset(&self) {
        self.cancel.reset();
    }

    /// Refuses work that is predicted to need more than the ceiling.
    ///
    /// # Errors
    /// [`ErrorKind::MemoryCeiling`], naming both sizes.
    pub fn check_memory(&self, bytes: u64) -> Result<()> {
        match self.ceiling {
            Some(ceiling) if bytes > ceiling => Err(Error::new(
                ErrorKind::MemoryCeiling,
                format!("about {bytes} bytes are needed, the ceiling is {ceiling}"),
            )),
            _ => Ok(()),
        }
    }

    /// Reports progress in [0, 1] and asks whether to go on; 0 when a call begins.
    ///
    /// # Errors
    /// [`ErrorKind::Cancelled`] if the callback or the flag says stop.
    pub fn report(&self, done: f64) -> Result<()> {
        let go_on = self.progress.as_ref().is_none_or(|callback| callback(done));
        if go_on { self.check_cancelled() } else { Err(cancelled()) }
    }

    /// Fails if the flag asks for a stop.
    ///
    /// # Errors
    /// [`ErrorKind::Cancelled`].
    pub(crate) fn check_cancelled(&self) -> Result<()> {
        if self.cancel.is_cancelled() { Err(cancelled()) } else { Ok(()) }
    }

    /// The number of elements per chunk for `n` elements.
    pub(crate) fn chunk_len(&self, n: usize) -> usize {
        self.chunk.unwrap_or_else(|| {
            // Serial work is cut too, so that a cancel is noticed soon.
            n.div_ceil(self.threads() * CHUNKS_PER_THREAD).max(SMALLEST_CHUNK)
        })
    }

    /// The ranges that `n` elements are cut into; none is empty.
    pub(crate) fn chunks(&self, n: usize) -> Vec<Range<usize>> {
        let len = self.chunk_len(n);
        (0..n.div_ceil(len)).map(|i| i * len..((i + 1) * len).min(n)).collect()
    }

    /// Runs `work` on every item, in any order, on this context's threads.
    ///
    /// Once a cancel is noticed the remaining items are skipped.
    pub(crate) fn for_each<I: Send>(
        &self,
        items: Vec<I>,
        work: impl Fn(I) + Sync + Send,
    ) -> Result<()> {
        self.map(items, work).map(drop)
    }

    /// Like [`Self::for_each`], collecting the results in the items' order.
    pub(crate) fn map<I: Send, R: Send>(
        &self,
        items: Vec<I>,
        work: impl Fn(I) -> R + Sync + Send,
    ) -> Result<Vec<R>> {
        let Some(pool) = self.pool().filter(|_| items.len() > 1) else {
            return items.into_iter().map(|i| self.check_cancelled().map(|()| work(i))).collect();
        };
        let slots: Vec<_> = items.into_iter().map(|i| Mutex::new((Some(i), None))).collect();
        self.spread(pool, slots.len(), &|place| {
            // Nobody else is at this slot, so that no lock waits or is poisoned.
            let slot = || slots[place].lock().unwrap_or_else(PoisonError::into_inner);
            let item = slot().0.take();
            let result = item.map(&work);
            slot().1 = result;
        })?;
        Ok(slots.into_iter().filter_map(|slot| slot.into_inner().ok()?.1).collect())
    }

    /// Runs `work` on every number below `n` on the threads of a pool. Not generic: all that a
    /// parallel iterator is made of is compiled here, and not once for each use.
    fn spread(&self, pool: &ThreadPool, n: usize, work: &(dyn Fn(usize) + Sync)) -> Result<()> {
        let guarded = |i| self.check_cancelled().map(|()| work(i));
        pool.install(|| (0..n).into_par_iter().try_for_each(guarded))
    }

    /// Fills a slice of records of `width` values; `work` gets the index of the
    /// first record of its part and the part.
    pub(crate) fn fill<T: Send>(
        &self,
        out: &mut [T],
        width: usize,
        work: impl Fn(usize, &mut [T]) + Sync + Send,
    ) -> Result<()> {
        self.fill_records(out, width.max(1), work)
    }

    /// The same for records `stride` values apart; the last one may be shorter.
    pub(crate) fn fill_records<T: Send>(
        &self,
        out: &mut [T],
        stride: usize,
        work: impl Fn(usize, &mut [T]) + Sync + Send,
    ) -> Result<()> {
        let len = self.chunk_len(out.len().div_ceil(stride));
        let parts: Vec<_> = out.chunks_mut(len.saturating_mul(stride)).enumerate().collect();
        self.for_each(parts, |(i, part)| work(i * len, part))
    }
}

impl fmt::Debug for Context {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Context")
            .field("threads", &self.threads())
            .field("memory_ceiling", &self.ceiling)
            .finish_non_exhaustive()
    }
}

fn cancelled() -> Error {
    Error::new(ErrorKind::Cancelled, "cancelled")
}

/// Options of a [`Context`].
#[derive(Debug)]
pub struct ContextBuilder {
    threads: usize,
    context: Context,
}

impl ContextBuilder {
    /// Threads to use: 1 is the calling thread only, 0 all cores.
    #[must_use]
    pub fn threads(mut self, n: usize) -> Self {
        self.threads = n;
        self
    }

    /// Bytes that a call may need in all; checked before anything is allocated.
    #[must_use]
    pub fn memory_ceiling(mut self, bytes: u64) -> Self {
        self.context.ceiling = Some(bytes);
        self
    }

    /// A callback that gets the part done, in [0, 1], and returns false to stop.
    /// It is called on the thread that made the call.
    #[must_use]
    pub fn progress(mut self, callback: impl Fn(f64) -> bool + Send + Sync + 'static) -> Self {
        self.context.progress = Some(Box::new(callback));
        self
    }

    /// Elements per chunk, for tests that spread small meshes over threads.
    #[doc(hidden)]
    #[must_use]
    pub fn chunk(mut self, elements: usize) -> Self {
        self.context.chunk = Some(elements.max(1));
        self
    }

    /// Starts the threads.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfResources`] if the system refuses them,
    /// [`ErrorKind::ParameterOutOfRange`] if more than 1024 are asked for.
    pub fn build(mut self) -> Result<Context> {
        let available = std::thread::available_parallelism().map_or(1, usize::from);
        let n = if self.threads == 0 { available.min(MOST_THREADS) } else { self.threads };
        if n > MOST_THREADS {
            return Err(Error::new(
                ErrorKind::ParameterOutOfRange,
                format!("{n} threads: the limit is {MOST_THREADS}"),
            ));
        }
        if n > 1 {
            self.context.pool = Some(Pool::start(n)?);
        }
        Ok(self.context)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Counts the threads that have ended, some time after they were told to.
    struct Leaving(Arc<std::sync::atomic::AtomicUsize>);

    impl Drop for Leaving {
        fn drop(&mut self) {
            std::thread::sleep(std::time::Duration::from_millis(20));
            self.0.fetch_add(1, Ordering::SeqCst);
        }
    }

    thread_local! {
        static LEAVING: std::cell::RefCell<Option<Leaving>> = const { std::cell::RefCell::new(None) };
    }

    #[test]
    fn threads_are_gone_with_their_context() {
        let gone = Arc::default();
        let context = Context::builder().threads(3).build().unwrap();
        let mark = |_: rayon::BroadcastContext| LEAVING.set(Some(Leaving(Arc::clone(&gone))));
        context.pool().unwrap().broadcast(mark);
        drop(context);
        assert_eq!(gone.load(Ordering::SeqCst), 3);
    }

    #[test]
    fn a_cancelled_context_stops_and_recovers() {
        let context = Context::builder().threads(2).chunk(1).build().unwrap();
        context.cancel_flag().cancel();
        let err = context.for_each(vec![1, 2, 3], |_| ()).unwrap_err();
        assert_eq!(err.kind(), ErrorKind::Cancelled);
        context.cancel_flag().reset();
        assert!(context.report(0.5).is_ok());
    }

    #[test]
    fn chunks_cover_everything_once() {
        for (threads, n) in [(1, 0), (1, 1), (2, 100_000), (7, 12_345)] {
            let context = Context::builder().threads(threads).build().unwrap();
            let mut next = 0;
            for range in context.chunks(n) {
                assert_eq!(range.start, next);
                assert!(!range.is_empty());
                next = range.end;
            }
            assert_eq!(next, n);
        }
    }

    #[test]
    fn the_ceiling_is_checked() {
        let context = Context::builder().memory_ceiling(10).build().unwrap();
        assert!(context.check_memory(10).is_ok());
        assert_eq!(context.check_memory(11).unwrap_err().kind(), ErrorKind::MemoryCeiling);
    }
}
