//! Tests of the kernel: `support` holds an independent reference, generators of
//! random meshes and exact numbers; the rest hold the kernel against them.

mod cost;
mod creases;
mod exact;
mod golden;
mod layers;
mod limits;
mod mesh;
mod oracle;
mod patches;
mod properties;
mod support;
mod topology;
mod tuned;
mod vertex_limits;
