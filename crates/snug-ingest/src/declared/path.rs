//! Where a value stands in a tree: `run.graph.torque`, `runs[0].torque`, `samples[].torque`, `run["torque.raw"]`.

use std::fmt;

/// One step from a value to one inside it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Segment {
    /// The field of this name.
    Key(String),
    /// The element at this place, counted from 0.
    Index(usize),
    /// Every element.
    Each,
}

/// Where a value stands; at least one step, the first by name unless the whole is a list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct DataPath {
    pub(crate) segments: Vec<Segment>,
}

impl DataPath {
    /// `None` for what is no path.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let mut segments = Vec::new();
        let mut rest = text;
        while !rest.is_empty() {
            if let Some(inside) = rest.strip_prefix('[') {
                let (segment, behind) = bracket(inside)?;
                segments.push(segment);
                rest = behind;
            } else {
                let name = match (segments.is_empty(), rest.strip_prefix('.')) {
                    (true, None) => rest,
                    (false, Some(name)) => name,
                    _ => return None,
                };
                let end = name.find(['.', '[']).unwrap_or(name.len());
                let key = &name[..end];
                if key.is_empty() || key.contains([']', '"']) {
                    return None;
                }
                segments.push(Segment::Key(key.to_owned()));
                rest = &name[end..];
            }
        }
        (!segments.is_empty()).then_some(Self { segments })
    }

    /// The first `count` steps as text.
    pub(crate) fn start(&self, count: usize) -> String {
        self.segments[..count.min(self.segments.len())]
            .iter()
            .fold(String::new(), |text, segment| joined(&text, segment))
    }
}

impl fmt::Display for DataPath {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.start(self.segments.len()))
    }
}

/// The path of what stands one step from `path`.
pub(crate) fn joined(path: &str, segment: &Segment) -> String {
    match segment {
        Segment::Key(key) if key.is_empty() || key.contains(['.', '[', ']', '"']) => {
            format!("{path}[{key:?}]")
        }
        Segment::Key(key) if path.is_empty() => key.clone(),
        Segment::Key(key) => format!("{path}.{key}"),
        Segment::Index(index) => format!("{path}[{index}]"),
        Segment::Each => format!("{path}[]"),
    }
}

/// What stands in a bracket that has been opened, and what follows it.
fn bracket(inside: &str) -> Option<(Segment, &str)> {
    if let Some(quoted) = inside.strip_prefix('"') {
        let mut key = String::new();
        let mut letters = quoted.char_indices();
        while let Some((at, letter)) = letters.next() {
            match letter {
                '\\' => key.push(letters.next()?.1),
                '"' => return Some((Segment::Key(key), quoted[at + 1..].strip_prefix(']')?)),
                _ => key.push(letter),
            }
        }
        return None;
    }
    let (index, behind) = inside.split_once(']')?;
    if index.is_empty() {
        return Some((Segment::Each, behind));
    }
    let digits = index.bytes().all(|byte| byte.is_ascii_digit());
    let index = index.parse().ok().filter(|_| digits)?;
    Some((Segment::Index(index), behind))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_read_and_written() {
        for text in [
            "torque",
            "tightening steps[0].graph.angle values",
            "runs[0].torque",
            "samples[].torque",
            "[].torque",
            "a[1][2].b",
            "run[\"torque.raw\"].x",
            "a[\"say \\\"so\\\"\"]",
            "größe.µ",
        ] {
            let path = DataPath::parse(text).unwrap_or_else(|| panic!("{text}"));
            assert_eq!(path.to_string(), text);
        }
    }

    #[test]
    fn what_is_no_path() {
        for text in [
            "",
            ".",
            "a.",
            ".a",
            "a..b",
            "a[",
            "a[x]",
            "a[-1]",
            "a[1",
            "a]",
            "a[\"b]",
            "a[0]b",
            "a[99999999999999999999]",
            "a\"b",
        ] {
            assert_eq!(DataPath::parse(text), None, "{text}");
        }
    }
}
