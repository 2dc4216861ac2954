//! What is data for programs that link Snug and a sentence in its files.

/// A type that files hold as the text it is displayed as.
macro_rules! written_as_said {
    ($($type:ty),+) => {$(
        impl serde::Serialize for $type {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.collect_str(self)
            }
        }
    )+};
}

pub(super) use written_as_said;
