//! A page in the words of a machine: its texts, and those of its pictures, but no address, script or quotation of a file.

use snug_campaign::words::vocabulary::Vocabulary;

/// Elements whose content stays as it is.
const QUOTED: [&str; 4] = ["style", "pre", "code", "script"];
/// What the page's script draws.
const DRAWN: &str = "application/json";
/// Attributes that people read or hear.
const READ: [&str; 3] = [" title=\"", " aria-label=\"", " placeholder=\""];

/// A page's markup in the words of the rig at hand.
pub fn markup(page: &str, vocabulary: Vocabulary) -> String {
    let mut told = String::with_capacity(page.len());
    let mut rest = page;
    while let Some(start) = rest.find('<') {
        told += &vocabulary.says(&rest[..start]);
        rest = &rest[start..];
        let end = rest.find('>').map_or(rest.len(), |end| end + 1);
        let (tag, after) = rest.split_at(end);
        told += &attributes(tag, vocabulary);
        rest = after;
        let is_called = |name: &&&str| {
            let behind = tag[1..].strip_prefix(**name);
            behind.is_some_and(|behind| behind.starts_with([' ', '>']))
        };
        if let Some(name) = QUOTED.iter().find(is_called) {
            let end = rest.find(&format!("</{name}>")).unwrap_or(rest.len());
            let (content, after) = rest.split_at(end);
            match tag.contains(DRAWN) {
                true => told += &vocabulary.says(content),
                false => told += content,
            }
            rest = after;
        }
    }
    told + &vocabulary.says(rest)
}

/// A tag with what people read of it in other words.
fn attributes(tag: &str, vocabulary: Vocabulary) -> String {
    READ.iter().fold(tag.to_owned(), |tag, name| {
        let Some((before, value)) = tag.split_once(name) else {
            return tag;
        };
        match value.split_once('"') {
            Some((value, after)) => {
                format!("{before}{name}{}\"{after}", vocabulary.says(value))
            }
            None => tag,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_told_and_addresses_stay() {
        let page = r##"<p title="a tightening"><a href="#tightenings">Tightenings</a> in <code>tightening</code>, tightenings.csv</p>"##;
        assert_eq!(
            markup(page, Vocabulary::Machine(None)),
            r##"<p title="a recording"><a href="#tightenings">Recordings</a> in <code>tightening</code>, tightenings.csv</p>"##
        );
    }
}
