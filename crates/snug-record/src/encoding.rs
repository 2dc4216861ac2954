//! How messages are written: their schema, JSON made fit for viewers, protobuf's wire format.

pub(crate) mod schema;
pub(crate) mod shape;
pub(crate) mod wire;
