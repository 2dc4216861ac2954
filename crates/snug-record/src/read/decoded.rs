//! What every decoder of messages makes of one.

/// What came of decoding one message; reasons are fixed sentences, so that equal ones are counted together.
pub(super) type Decoded = Result<(), &'static str>;

/// Arrays are spread out element by element up to this length; longer ones (images, point clouds) are no signal.
pub(super) const LONGEST_ARRAY: usize = 256;

/// Why an array was left out.
pub(super) const ARRAY_TOO_LONG: &str = "an array is longer than 256 elements and was left out";
