//! The `carvel` command.

fn main() {}
