//! What an error shows of a text that somebody else wrote.

/// Characters of a stranger's text that a message shows: an expression or a name as people write them, on one line. Chosen.
const SHOWN: usize = 120;

/// The text, or its beginning and how long it is where it is longer than anyone wants to read in a message.
pub fn excerpt(text: &str) -> String {
    match text.char_indices().nth(SHOWN) {
        None => text.to_owned(),
        Some((end, _)) => {
            format!("{}… ({} characters)", &text[..end], text.chars().count())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_texts_are_cut_between_characters() {
        let longest = "ä".repeat(SHOWN);
        assert_eq!(excerpt(&longest), longest);
        let cut = excerpt(&"ä".repeat(2_000_000));
        assert_eq!(cut, format!("{longest}… (2000000 characters)"));
    }
}
