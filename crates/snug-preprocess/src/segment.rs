//! A segment of a recording: its channels, what is said of it, its window, and what all segments share.

pub(crate) mod channel;
pub(crate) mod context;
pub(crate) mod integration;
pub(crate) mod peak_torque;
pub(crate) mod remarks;
pub(crate) mod signals;
pub(crate) mod window;
