//! Text of a file within a message.

/// Characters of a file's text that a message shows.
const SHOWN: usize = 80;

/// The start of a text, for a message; `…` stands for the rest.
pub(crate) fn excerpt(text: &str) -> String {
    cut(text, SHOWN)
}

/// At most so many characters of a text.
pub(crate) fn cut(text: &str, characters: usize) -> String {
    match text.char_indices().nth(characters) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_long_text_is_cut() {
        assert_eq!(excerpt("torque µ"), "torque µ");
        let cut = excerpt(&"µ".repeat(1_000_000));
        assert_eq!(cut.chars().count(), SHOWN + 1);
        assert!(cut.ends_with('…'));
    }
}
