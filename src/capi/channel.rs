//! `carvel_channel`: values at the corners of faces, with seams.

use super::buffer::{Name, Target, check_pointer, input};
use super::guard::{Call, call};
use super::object::{destroy_function, look, object};
use super::status::{CARVEL_STATUS_LENGTH_MISMATCH, Fault, Result, carvel_status};
use super::values::{ConstValues, Records, Values, carvel_indices};
use super::versioned::{init_function, read, versioned};
use super::{carvel_error, carvel_mesh, carvel_scheme};
use crate::base::Scalar;
use crate::hierarchy::Prediction;
use crate::mesh::{Channel, FaceVaryingMode, Mesh};
use crate::scheme::{ChannelRules, Scheme};
use std::sync::Arc;

object!(carvel_channel, Bound);

/// A channel and the mesh that it was made for.
pub(super) struct Bound {
    pub(super) channel: Channel,
    pub(super) mesh: Arc<Mesh>,
}

impl Bound {
    /// The sizes at each level; what they call vertices are the values.
    fn plan(&self, scheme: &Scheme, levels: u32) -> Result<Prediction> {
        if levels > 0 {
            ChannelRules::new(scheme, self.channel.mode()).check()?;
        }
        Ok(Prediction::of_channel(&self.channel, scheme, levels)?)
    }

    /// Refuses another mesh than the one that the channel was made for, or its like.
    fn check_mesh(&self, mesh: &Arc<Mesh>, name: Name) -> Result<()> {
        if Arc::ptr_eq(&self.mesh, mesh) || self.mesh == *mesh {
            return Ok(());
        }
        Err(Fault::new(
            CARVEL_STATUS_LENGTH_MISMATCH,
            format!("{name}: the channel was made for another mesh"),
        ))
    }
}

pub const CARVEL_FACE_VARYING_CORNERS: i32 = 0;
pub const CARVEL_FACE_VARYING_SMOOTH: i32 = 1;
pub const CARVEL_FACE_VARYING_CORNERS_PLUS1: i32 = 2;
pub const CARVEL_FACE_VARYING_CORNERS_PLUS2: i32 = 3;
pub const CARVEL_FACE_VARYING_BOUNDARIES: i32 = 4;
pub const CARVEL_FACE_VARYING_ALL: i32 = 5;

fn mode(mode: i32) -> Result<FaceVaryingMode> {
    match mode {
        CARVEL_FACE_VARYING_CORNERS => Ok(FaceVaryingMode::Corners),
        CARVEL_FACE_VARYING_SMOOTH => Ok(FaceVaryingMode::Smooth),
        CARVEL_FACE_VARYING_CORNERS_PLUS1 => Ok(FaceVaryingMode::CornersPlus1),
        CARVEL_FACE_VARYING_CORNERS_PLUS2 => Ok(FaceVaryingMode::CornersPlus2),
        CARVEL_FACE_VARYING_BOUNDARIES => Ok(FaceVaryingMode::Boundaries),
        CARVEL_FACE_VARYING_ALL => Ok(FaceVaryingMode::All),
        other => Err(Fault::out_of_range(format!("there is no face-varying mode {other}"))),
    }
}

versioned! {
    pub struct carvel_channel_desc {
        pub struct_size: u32,
        pub mode: i32,
        pub indices: *const u32,
        pub index_count: u64,
        pub value_count: u64,
    }
}

impl carvel_channel_desc {
    /// # Safety
    /// The pointer leads to as many entries as the count says.
    unsafe fn make(&self, mesh: &Arc<Mesh>) -> Result<Bound> {
        let mode = mode(self.mode)?;
        // SAFETY: the caller's contract.
        let indices = unsafe { input(self.indices, self.index_count, "indices")? };
        let channel = Channel::new(mesh, indices, self.value_count as usize, mode)?;
        Ok(Bound { channel, mesh: Arc::clone(mesh) })
    }
}

/// Values of a channel to refine.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ChannelInput<T> {
    pub channel: *const carvel_channel,
    pub values: ConstValues<T>,
}

/// Where refined values of a channel go.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ChannelOutput<T> {
    pub indices: carvel_indices,
    pub values: Values<T>,
}

pub type carvel_channel_input_f32 = ChannelInput<f32>;
pub type carvel_channel_input_f64 = ChannelInput<f64>;
pub type carvel_channel_output_f32 = ChannelOutput<f32>;
pub type carvel_channel_output_f64 = ChannelOutput<f64>;

/// A channel of a call, checked, and its sizes.
pub(super) struct Lent<'a> {
    pub(super) channel: &'a Channel,
    pub(super) plan: Prediction,
}

impl<T: Scalar> ChannelInput<T> {
    /// Checks the channel and the values.
    ///
    /// # Safety
    /// The header's contract.
    pub(super) unsafe fn check<'a>(
        &self,
        call: &mut Call<'a>,
        (mesh, scheme, levels): (&Arc<Mesh>, &Scheme, u32),
        name: Name,
    ) -> Result<(Lent<'a>, Records<*const T>)> {
        // SAFETY: the caller's contract.
        let bound = unsafe { call.object(self.channel)? };
        bound.check_mesh(mesh, name)?;
        let plan = bound.plan(scheme, levels)?;
        plan.check_index_type()?;
        let records = self.values.check(bound.channel.values() as u64, name)?;
        Ok((Lent { channel: &bound.channel, plan }, records))
    }
}

impl<T: Scalar> ChannelOutput<T> {
    /// Checks the room for the values.
    pub(super) fn check(
        &self,
        plan: &Prediction,
        width: usize,
        name: Name,
    ) -> Result<Records<*mut T>> {
        self.values.check(plan.last().vertices, width, name)
    }

    /// The room for the indices.
    pub(super) fn target(&self, plan: &Prediction, name: Name) -> Target<u32> {
        Target::new((self.indices.data, self.indices.count), plan.last().corners, name)
    }
}

init_function!(carvel_channel_desc_init, carvel_channel_desc);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_channel_create(
    mesh: *const carvel_mesh,
    desc: *const carvel_channel_desc,
    out: *mut *mut carvel_channel,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| call.create(out, |call| read(desc)?.make(&call.object(mesh)?.mesh)))
    }
}

destroy_function!(carvel_channel_destroy, carvel_channel);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_channel_seam_edges(channel: *const carvel_channel) -> u64 {
    // SAFETY: the header's contract.
    let bound = unsafe { look(channel) }.map(|handle| &handle.value);
    bound.map_or(0, |bound| bound.channel.seam_edges(&bound.mesh) as u64)
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_predict_channel(
    channel: *const carvel_channel,
    scheme: *const carvel_scheme,
    level: u32,
    values: *mut u64,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let (bound, scheme) = (call.object(channel)?, call.object(scheme)?);
            check_pointer(values, "values")?;
            values.write(bound.plan(scheme, level)?.last().vertices);
            Ok(())
        })
    }
}
