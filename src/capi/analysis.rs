//! What a scheme does around a feature.

use super::guard::call;
use super::status::{Fault, Result, carvel_status};
use super::versioned::{check, init_function, initial, versioned, write};
use super::{carvel_error, carvel_scheme};
use crate::analysis::surface::{
    CharacteristicMap, Curvature, Feature, LocalMatrix, Smoothness, Spectrum, Tangent,
};
use crate::scheme::Scheme;

pub const CARVEL_FEATURE_INTERIOR: i32 = 0;
pub const CARVEL_FEATURE_BOUNDARY: i32 = 1;
pub const CARVEL_FEATURE_CORNER: i32 = 2;
pub const CARVEL_FEATURE_CREASE: i32 = 3;
pub const CARVEL_FEATURE_DART: i32 = 4;

pub const CARVEL_TANGENT_CONTINUOUS: i32 = 0;
pub const CARVEL_TANGENT_FOLDED: i32 = 1;
pub const CARVEL_TANGENT_UNDEFINED: i32 = 2;
pub const CARVEL_TANGENT_SHARP: i32 = 3;

pub const CARVEL_CURVATURE_NO_VERDICT: i32 = 0;
pub const CARVEL_CURVATURE_VANISHING: i32 = 1;
pub const CARVEL_CURVATURE_BOUNDED: i32 = 2;
pub const CARVEL_CURVATURE_GROWING: i32 = 3;
pub const CARVEL_CURVATURE_UNBOUNDED: i32 = 4;

versioned! {
    pub struct carvel_feature_analysis {
        pub struct_size: u32,
        pub tangent: i32,
        pub curvature: i32,
        pub is_injective: i32,
        pub lambda: f64,
        pub mu: f64,
        pub least_jacobian: f64,
        pub sample_count: u64,
    }
}

fn feature(kind: i32, faces: u64) -> Result<Feature> {
    // The library has a limit of its own.
    let faces = usize::try_from(faces).unwrap_or(usize::MAX);
    match kind {
        CARVEL_FEATURE_INTERIOR => Ok(Feature::Interior { valence: faces }),
        CARVEL_FEATURE_BOUNDARY => Ok(Feature::Boundary { faces }),
        CARVEL_FEATURE_CORNER => Ok(Feature::Corner { faces }),
        CARVEL_FEATURE_CREASE => Ok(Feature::Crease { faces: [faces / 2, faces - faces / 2] }),
        CARVEL_FEATURE_DART => Ok(Feature::Dart { valence: faces }),
        other => Err(Fault::out_of_range(format!("there is no feature {other}"))),
    }
}

impl carvel_feature_analysis {
    fn of(scheme: &Scheme, feature: Feature) -> Result<Self> {
        let spectrum = Spectrum::new(&LocalMatrix::new(scheme, feature)?)?;
        let map = CharacteristicMap::new(scheme, &spectrum)?;
        let verdict = Smoothness::of(&spectrum, map.as_ref());
        Ok(Self {
            tangent: match verdict.tangent {
                Tangent::Continuous => CARVEL_TANGENT_CONTINUOUS,
                Tangent::Folded => CARVEL_TANGENT_FOLDED,
                Tangent::Undefined => CARVEL_TANGENT_UNDEFINED,
                Tangent::Sharp => CARVEL_TANGENT_SHARP,
            },
            curvature: match verdict.curvature {
                None => CARVEL_CURVATURE_NO_VERDICT,
                Some(Curvature::Vanishing) => CARVEL_CURVATURE_VANISHING,
                Some(Curvature::Bounded) => CARVEL_CURVATURE_BOUNDED,
                Some(Curvature::Growing) => CARVEL_CURVATURE_GROWING,
                Some(Curvature::Unbounded) => CARVEL_CURVATURE_UNBOUNDED,
            },
            is_injective: i32::from(map.as_ref().is_some_and(|map| map.injective)),
            lambda: verdict.lambda,
            mu: verdict.mu,
            least_jacobian: map.as_ref().map_or(0.0, |map| map.least_jacobian),
            sample_count: map.as_ref().map_or(0, |map| map.samples as u64),
            ..initial()
        })
    }
}

init_function!(carvel_feature_analysis_init, carvel_feature_analysis);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_scheme_analyse(
    scheme: *const carvel_scheme,
    kind: i32,
    faces: u64,
    analysis: *mut carvel_feature_analysis,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let scheme = call.object(scheme)?;
            check(analysis)?;
            write(analysis, &carvel_feature_analysis::of(scheme, feature(kind, faces)?)?)
        })
    }
}
