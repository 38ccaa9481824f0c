//! The border to C++: flat arrays in and out, errors as [`cxx::Exception`].

/// What the shims offer.
#[cxx::bridge(namespace = "carvel_peers")]
pub(crate) mod ffi {
    /// A number type of positions.
    #[derive(Debug)]
    enum Precision {
        Single,
        Double,
    }

    /// A polygon soup.
    struct Soup<'a> {
        sizes: &'a [u32],
        indices: &'a [u32],
        positions: &'a [f64],
    }

    /// What OpenSubdiv keeps beside the faces.
    struct Tags<'a> {
        crease_ends: &'a [u32],
        crease_sharpness: &'a [f32],
        corners: &'a [u32],
        corner_sharpness: &'a [f32],
        holes: &'a [u32],
        /// The number of values of each face-varying channel.
        channel_values: &'a [u32],
        /// Per channel one index for each corner, one channel after the other.
        channel_indices: &'a [u32],
    }

    /// OpenSubdiv's options, by the numbers of its own enumerations.
    struct OsdOptions {
        scheme: u8,
        boundary: u8,
        face_varying: u8,
        creasing: u8,
        triangles: u8,
    }

    /// The sizes of a mesh.
    struct Counts {
        vertices: usize,
        faces: usize,
        corners: usize,
    }

    unsafe extern "C++" {
        include!("carvel-peers/shim/run.hpp");

        /// A control mesh in a library's own memory, and what became of it.
        type Run;

        /// Puts the control mesh back; not timed.
        fn prepare(self: Pin<&mut Run>) -> Result<()>;
        /// The library's ordinary call; timed.
        fn refine(self: Pin<&mut Run>, levels: u32) -> Result<()>;
        /// Frees the result.
        fn clear(self: Pin<&mut Run>);
        fn counts(self: &Run) -> Counts;
        fn copy(
            self: &Run,
            sizes: &mut [u32],
            indices: &mut [u32],
            positions: &mut [f64],
        ) -> Result<()>;

        include!("carvel-peers/shim/openmesh.hpp");

        fn openmesh_version() -> String;
        fn openmesh_run(soup: &Soup, scheme: u8, precision: Precision) -> Result<UniquePtr<Run>>;

        include!("carvel-peers/shim/cgal.hpp");

        fn cgal_version() -> String;
        fn cgal_run(soup: &Soup, scheme: u8, precision: Precision) -> Result<UniquePtr<Run>>;

        include!("carvel-peers/shim/opensubdiv.hpp");

        /// A topology refiner and its values.
        type Osd;

        fn osd_version() -> String;
        fn osd_new(
            soup: &Soup,
            tags: &Tags,
            options: &OsdOptions,
            precision: Precision,
        ) -> Result<UniquePtr<Osd>>;
        fn osd_into_run(osd: UniquePtr<Osd>) -> UniquePtr<Run>;
        /// As [`Run::refine`].
        fn osd_refine(osd: Pin<&mut Osd>, levels: u32) -> Result<()>;
        /// As [`Run::copy`].
        fn osd_copy(
            osd: &Osd,
            sizes: &mut [u32],
            indices: &mut [u32],
            positions: &mut [f64],
        ) -> Result<()>;
        fn level_counts(self: &Osd, level: u32) -> Result<Counts>;
        fn copy_faces(
            self: &Osd,
            level: u32,
            sizes: &mut [u32],
            indices: &mut [u32],
            holes: &mut [u8],
        ) -> Result<()>;
        /// Per vertex of a level 0, 1 or 2 and a vertex, the ends of an edge, or a
        /// face of the level before; per face its parent.
        fn copy_lineage(
            self: &Osd,
            level: u32,
            kinds: &mut [u8],
            parents: &mut [u32],
            face_parents: &mut [u32],
        ) -> Result<()>;
        fn channel_size(self: &Osd, channel: u32) -> Result<usize>;
        fn copy_channel(self: &Osd, channel: u32, indices: &mut [u32]) -> Result<()>;
        /// Values from level 0 to the last; `kind` 0 vertex, 1 varying, 2 face-varying.
        fn interpolate(
            self: &Osd,
            kind: u8,
            channel: u32,
            values: &[f64],
            width: usize,
            out: &mut [f64],
        ) -> Result<()>;
        /// Limits of a level's vertices and two tangents there.
        fn osd_limits(
            soup: &Soup,
            tags: &Tags,
            options: &OsdOptions,
            level: u32,
            points: &mut [f64],
            first: &mut [f64],
            second: &mut [f64],
        ) -> Result<()>;
        /// The library's warnings on this thread since the last call.
        fn osd_take_warnings() -> Vec<String>;

        include!("carvel-peers/shim/stencils.hpp");

        /// A composed table for the vertices of a level, or for places on the limit.
        type Stencils;

        fn stencils_new(
            soup: &Soup,
            tags: &Tags,
            options: &OsdOptions,
            precision: Precision,
            level: u32,
        ) -> Result<UniquePtr<Stencils>>;
        /// The level's values without a table, by `PrimvarRefiner` through all levels.
        fn levels_new(
            soup: &Soup,
            tags: &Tags,
            options: &OsdOptions,
            precision: Precision,
            level: u32,
        ) -> Result<UniquePtr<Stencils>>;
        /// Places: a ptex face and (s, t) in it; `isolation` levels of features.
        fn limit_stencils_new(
            soup: &Soup,
            tags: &Tags,
            options: &OsdOptions,
            precision: Precision,
            isolation: u32,
            faces: &[u32],
            parameters: &[f64],
        ) -> Result<UniquePtr<Stencils>>;
        /// Makes the table of a level anew from its refiner; timed.
        fn create(self: Pin<&mut Stencils>) -> Result<()>;
        /// Frees that table.
        fn clear(self: Pin<&mut Stencils>);
        /// Applies the table to the control positions; timed.
        fn update(self: Pin<&mut Stencils>) -> Result<()>;
        fn rows(self: &Stencils) -> usize;
        fn bytes(self: &Stencils) -> usize;
        /// 0 positions, 1 and 2 the derivatives of a limit table.
        fn copy_values(self: &Stencils, which: u8, out: &mut [f64]) -> Result<()>;

        include!("carvel-peers/shim/surface.hpp");

        /// Patches of the limit surface, and samples on them.
        type Patches;

        /// `Far::PatchTable` with Gregory end caps; `isolation` levels of features, up to 10.
        fn far_patches_new(
            soup: &Soup,
            tags: &Tags,
            options: &OsdOptions,
            precision: Precision,
            isolation: u32,
        ) -> Result<UniquePtr<Patches>>;
        /// `Bfr::Surface` of each face; the same levels for smooth and sharp features.
        fn bfr_patches_new(
            soup: &Soup,
            tags: &Tags,
            options: &OsdOptions,
            precision: Precision,
            isolation: u32,
        ) -> Result<UniquePtr<Patches>>;
        /// Where to evaluate: a face, a sector, and (u, v) for each sample.
        fn place(
            self: Pin<&mut Patches>,
            faces: &[u32],
            sectors: &[u32],
            parameters: &[f64],
        ) -> Result<()>;
        /// One, three or six records of each sample; timed.
        fn evaluate(self: Pin<&mut Patches>, records: u8) -> Result<()>;
        #[rust_name = "copy_samples"]
        fn copy(self: &Patches, out: &mut [f64]) -> Result<()>;

        include!("carvel-peers/shim/heap.hpp");

        fn heap_fresh();
        fn heap_keep();
        fn heap_trim();
        fn cpu_seconds() -> f64;
    }
}
