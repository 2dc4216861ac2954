//! p values adjusted for having looked at many: an adjusted p below α keeps the stated error
//! rate over the whole table at α.

mod benjamini_hochberg;

pub use benjamini_hochberg::benjamini_hochberg;
