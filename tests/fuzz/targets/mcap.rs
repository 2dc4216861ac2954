//! Recordings: Snug's own and the numbers of any other; and what makes a cut one whole.

use super::{LEVER_ARM_M, Target};
use crate::mutation::Mutation;
use snug_ingest::Source;
use std::path::Path;

pub const TARGET: Target = Target {
    name: "mcap",
    file: "input.mcap",
    mutate: Mutation::bytes,
    attempt,
};

pub fn attempt(file: &Path, input: &[u8]) {
    let _ = snug_ingest::read(&Source::default(), file, LEVER_ARM_M);
    let _ = snug_record::read::numeric_channels(input);
    let mut whole = Vec::new();
    if let Ok(recovery) = snug_record::recover(input, &mut whole) {
        let again = snug_record::recover(&whole, std::io::sink())
            .expect("what was made whole is a recording");
        assert!(
            again.was_complete,
            "what was made whole is whole: {recovery:?}"
        );
        assert_eq!(again.messages, recovery.messages);
    }
}
