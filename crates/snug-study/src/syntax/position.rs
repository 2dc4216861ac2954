//! Where a field stands in a study file, for errors that are found only after the file was read.

use std::fmt;
use std::ops::Range;

/// A place in a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Position {
    /// 1-based line.
    pub(crate) line: usize,
    /// 1-based column, in characters.
    pub(crate) column: usize,
}

impl fmt::Display for Position {
    fn fmt(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(text, "line {}, column {}", self.line, self.column)
    }
}

/// The place of the field that `path` names, for example `selection.minimum_fit_percent`; of its nearest parent where the
/// text does not state the field itself; `None` where it states nothing of it.
///
/// Between a parent and its field there may be further levels, as in `window: Pulse(start_s: 1.5)` for
/// `window.start_s`: the outermost field of that name counts.
pub(crate) fn of_field(text: &str, path: &str) -> Option<Position> {
    let keys = keys(text);
    let mut within = 0..text.len();
    let mut found = None;
    for name in path.split('.') {
        let inside = keys
            .iter()
            .filter(|key| key.name == name && within.contains(&key.at));
        let Some(key) = inside.min_by_key(|key| (key.depth, key.at)) else {
            break;
        };
        found = Some(key.at);
        within = key.value.clone();
    }
    found.map(|at| position(text, at))
}

/// The field whose value stands at `place` or, behind white space, right after it, and what stands there:
/// `("minimum_fit_percent", "abc")`.
///
/// `text` need not be well formed; `None` outside every field and at the text's end.
pub(crate) fn field_at(text: &str, place: Position) -> Option<(&str, &str)> {
    let at = behind_space(text, place)?;
    let rest = &text[at..];
    let fields = keys(text).into_iter();
    let innermost = fields
        .filter(|key| key.value.contains(&at))
        .max_by_key(|key| key.at)?;
    // A reader may have passed a sign: what is no list and no structure is told whole.
    let value = text[innermost.value].trim();
    let found = match value.contains(['(', '[', '{', '\n']) {
        true => &rest[..token(rest).length],
        false => value,
    };
    Some((innermost.name, found))
}

/// What stands at `place` or, behind white space, right after it; `None` at the text's end.
pub(crate) fn found_at(text: &str, place: Position) -> Option<&str> {
    let rest = &text[behind_space(text, place)?..];
    Some(&rest[..token(rest).length])
}

/// The innermost bracket that is open at `place`, or at the text's end where the text ends before.
pub(crate) fn open_at(text: &str, place: Position) -> Option<(char, Position)> {
    let until = behind_space(text, place).unwrap_or(text.len());
    let mut open = Vec::new();
    let mut at = 0;
    while at < until {
        let token = token(&text[at..]);
        match token.kind {
            Kind::Mark(mark @ ('(' | '[' | '{')) => open.push((mark, at)),
            Kind::Mark(')' | ']' | '}') => drop(open.pop()),
            _ => {}
        }
        at += token.length;
    }
    open.pop().map(|(mark, at)| (mark, position(text, at)))
}

/// Where a text in quotes begins that nothing closes.
pub(crate) fn open_text(text: &str) -> Option<Position> {
    let mut at = 0;
    while at < text.len() {
        let token = token(&text[at..]);
        let whole = &text[at..at + token.length];
        let is_closed = whole.len() > 1 && whole.ends_with('"');
        if whole.starts_with('"') && !is_closed {
            return Some(position(text, at));
        }
        at += token.length;
    }
    None
}

/// The byte at `place` or, behind white space, right after it; `None` at the text's end.
fn behind_space(text: &str, place: Position) -> Option<usize> {
    let (above, in_line) = (place.line.checked_sub(1)?, place.column.checked_sub(1)?);
    let mut lines = text.split_inclusive('\n');
    let line_start: usize = lines.by_ref().take(above).map(str::len).sum();
    let (bytes, _) = lines.next()?.char_indices().nth(in_line)?;
    let rest = text[line_start + bytes..].trim_start();
    (!rest.is_empty()).then(|| text.len() - rest.len())
}

fn position(text: &str, at: usize) -> Position {
    let before = &text[..at];
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    Position {
        line: before.matches('\n').count() + 1,
        column: before[line_start..].chars().count() + 1,
    }
}

/// A field's name or a map's key.
#[derive(Debug)]
struct Key<'a> {
    name: &'a str,
    at: usize,
    depth: usize,
    /// From the colon to the end of what stands in the same parentheses and belongs to it.
    value: Range<usize>,
}

/// Every `name:` and `"name":` of a RON text that is known to be well formed.
fn keys(text: &str) -> Vec<Key<'_>> {
    let mut keys: Vec<Key> = Vec::new();
    let mut open: Vec<usize> = Vec::new();
    let mut depth = 0usize;
    let mut last: Option<(usize, &str)> = None;
    let mut at = 0;
    while at < text.len() {
        let token = token(&text[at..]);
        let (start, end) = (at, at + token.length);
        at = end;
        match token.kind {
            Kind::Space => {}
            Kind::Name(name) => last = Some((start, name)),
            Kind::Mark(':') => {
                if let Some((at, name)) = last.take() {
                    open.push(keys.len());
                    let value = end..text.len();
                    keys.push(Key {
                        name,
                        at,
                        depth,
                        value,
                    });
                }
            }
            Kind::Mark(mark) => {
                last = None;
                let closes = matches!(mark, ')' | ']' | '}');
                if closes || mark == ',' {
                    while let Some(&index) = open.last().filter(|&&i| keys[i].depth == depth) {
                        keys[index].value.end = start;
                        open.pop();
                    }
                }
                match mark {
                    '(' | '[' | '{' => depth += 1,
                    _ if closes => depth = depth.saturating_sub(1),
                    _ => {}
                }
            }
        }
    }
    keys
}

enum Kind<'a> {
    /// White space and comments.
    Space,
    /// An identifier, or a string without its quotes.
    Name(&'a str),
    Mark(char),
}

struct Token<'a> {
    kind: Kind<'a>,
    length: usize,
}

/// The first token of a text that is not empty.
fn token(text: &str) -> Token<'_> {
    let until = |end: &str, from: usize| {
        text[from..]
            .find(end)
            .map_or(text.len(), |found| from + found + end.len())
    };
    let first = text.chars().next().unwrap_or(' ');
    let named = |length: usize, name| Token {
        kind: Kind::Name(name),
        length,
    };
    let space = |length| Token {
        kind: Kind::Space,
        length,
    };
    if text.starts_with("//") {
        return space(until("\n", 2));
    }
    if text.starts_with("/*") {
        return space(until("*/", 2));
    }
    if text.starts_with("r#\"") {
        return named(until("\"#", 3), "");
    }
    if first == '"' {
        let length = string_length(text);
        return named(length, text.get(1..length - 1).unwrap_or(""));
    }
    if first == '\'' {
        // A character, possibly escaped: '\'' is one.
        let from = if text[1..].starts_with('\\') { 3 } else { 2 };
        let from = (from..=text.len()).find(|&at| text.is_char_boundary(at));
        return space(until("'", from.unwrap_or(text.len())));
    }
    let word = |c: char| c.is_alphanumeric() || c == '_';
    if word(first) {
        let length = text.find(|c| !word(c)).unwrap_or(text.len());
        return named(length, &text[..length]);
    }
    if first.is_whitespace() {
        return space(first.len_utf8());
    }
    Token {
        kind: Kind::Mark(first),
        length: first.len_utf8(),
    }
}

/// Bytes of a string with both quotes; `\"` does not end it.
fn string_length(text: &str) -> usize {
    let mut escaped = false;
    for (at, character) in text.char_indices().skip(1) {
        match character {
            '"' if !escaped => return at + 1,
            '\\' => escaped = !escaped,
            _ => escaped = false,
        }
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    const STUDY: &str = r#"// selection: (minimum_fit_percent: 1.0)
(
    title: "a: (b) \" start_s: 3", /* window: */
    source: (format: Csv(
        comment: ';', channels: [(column: Name("µ"), unit: One), (unit: Volt)],
        sampling: Rate(hz: -1.0),
    )),
    preprocess: (rig: (lever_arm_m: 0.3), window: Pulse(start_s: 1.5)),
    model: (parameters: { "mass_kg": (value: -1.0, fixed: true) }),
    selection: (tool_mass_kg: 2.6,
        /* µµ */ minimum_fit_percent: 101),
)"#;

    fn at(path: &str) -> Option<(usize, usize)> {
        of_field(STUDY, path).map(|position| (position.line, position.column))
    }

    /// Lines and columns as an editor counts them.
    #[test]
    fn fields_are_found_where_they_stand() {
        for (path, place) in [
            ("selection.minimum_fit_percent", (11, 18)),
            ("preprocess.window.start_s", (8, 57)),
            ("preprocess.rig.lever_arm_m", (8, 24)),
            ("source.sampling.hz", (6, 24)),
            ("source.channels", (5, 23)),
            ("model.parameters.mass_kg", (9, 27)),
            ("model.parameters.mass_kg.fixed", (9, 52)),
        ] {
            assert_eq!(at(path), Some(place), "{path}");
        }
    }

    #[test]
    fn what_stands_at_a_place_is_named_with_its_field() {
        let text = "(\n  title: 'µ',\n  selection: (minimum_fit_percent: abc, x: \"b c\")\n";
        let at = |line, column| field_at(text, Position { line, column });
        assert_eq!(at(3, 36), Some(("minimum_fit_percent", "abc")));
        assert_eq!(at(3, 35), Some(("minimum_fit_percent", "abc")));
        assert_eq!(at(3, 44), Some(("x", "\"b c\"")));
        assert_eq!(
            field_at("(seed: -1)", Position { line: 1, column: 9 }),
            Some(("seed", "-1"))
        );
        assert_eq!(at(1, 1), None);
        assert_eq!(at(9, 9), None);
        assert_eq!(at(3, 99), None);
    }

    #[test]
    fn what_is_not_stated_has_the_place_of_its_parent_or_none() {
        assert_eq!(at("selection.noise_limited_ratio"), at("selection"));
        assert_eq!(at("record.gap_s"), None);
        assert_eq!(at("start_s"), at("preprocess.window.start_s"));
    }
}
