//! The `carvel` command.

#[cfg(test)]
mod preview;

fn main() {}
