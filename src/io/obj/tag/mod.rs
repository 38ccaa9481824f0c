//! Subdivision tags in OBJ: the statement `t` of OpenSubdiv's shape files.
//!
//! `t NAME i/f/s` is followed by i integers, f numbers and s words. Vertices and
//! faces count **from 0** here, unlike those of `f`, and never backwards.
//!
//! | statement | meaning |
//! |---|---|
//! | `t crease 2/1/0 a b s` | the edge a-b has sharpness s |
//! | `t crease 2n/1/0 …`, `t crease 2n/n/0 …` | n edges by pairs, one sharpness or one each |
//! | `t crease n/1/0 …` (n odd), `t crease n/n-1/0 …` | a chain of n−1 edges, likewise |
//! | `t corner n/1/0 …`, `t corner n/n/0 …` | n sharp vertices, one sharpness or one each |
//! | `t hole n/0/0 …` | n faces that are holes |
//! | `t interpolateboundary 1/0/0 i` | 0 none, 1 edge and corner, 2 edge only |
//! | `t facevaryinginterpolateboundary 1/0/0 i` | 0 none, 1 corners only, 2 and 3 corners plus 1 and plus 2, 4 boundaries, 5 all |
//! | `t creasemethod 0/0/1 w` | `normal` or `chaikin` |
//! | `t smoothtriangles 0/0/1 w` | `catmark` or `smooth` |
//!
//! OpenSubdiv's reader takes pairs, and writers of such files put one edge on a line;
//! chains are how RenderMan passes the same tag. An even number of vertices with one
//! sharpness is taken as pairs. Of several sharpnesses of one edge or vertex the last
//! holds, as there. What OpenSubdiv clamps or overlooks (a negative sharpness, values
//! missing) is refused here.

mod read;
mod settle;
mod write;

pub(super) use read::Tags;
pub(super) use write::write;

use crate::io::{BoundaryTag, CreasingTag, FaceVaryingTag, TriangleTag};

/// In the order of their numbers in a file.
const BOUNDARIES: [BoundaryTag; 3] =
    [BoundaryTag::None, BoundaryTag::EdgeAndCorner, BoundaryTag::Edge];

/// In the order of their numbers in a file.
const FACE_VARYING: [FaceVaryingTag; 6] = [
    FaceVaryingTag::None,
    FaceVaryingTag::CornersOnly,
    FaceVaryingTag::CornersPlus1,
    FaceVaryingTag::CornersPlus2,
    FaceVaryingTag::Boundaries,
    FaceVaryingTag::All,
];

const CREASINGS: [(&str, CreasingTag); 2] =
    [("normal", CreasingTag::Uniform), ("chaikin", CreasingTag::Chaikin)];

const TRIANGLES: [(&str, TriangleTag); 2] =
    [("catmark", TriangleTag::CatmullClark), ("smooth", TriangleTag::Smooth)];
