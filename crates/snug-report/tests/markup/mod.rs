//! A small reader of HTML, strict enough to notice an element that is not closed or text that became markup.

/// Elements that have no end.
const VOID: [&str; 4] = ["meta", "link", "input", "br"];

/// One start tag: its name and everything up to its `>`.
pub struct Tag {
    pub name: String,
    pub attributes: String,
}

/// Nothing that is not finite reaches a drawing.
pub fn assert_finite_attributes(page: &str) {
    for Tag { name, attributes } in start_tags(page).expect("the page is well formed") {
        for word in ["NaN", "\"inf"] {
            assert!(!attributes.contains(word), "{name} {attributes}");
        }
    }
}

/// Names of a page's sections, in order; its list of contents leads to just its chapters, and they to just their sections.
pub fn sections(page: &str) -> Vec<&str> {
    let (_, rest) = page
        .split_once("<nav class=\"contents\"")
        .expect("a list of contents");
    let (contents, rest) = rest.split_once("</nav>").expect("its end");
    let listed = between(contents, "href=\"#", "\"");
    assert_eq!(listed, between(rest, "<div class=\"chapter\" id=\"", "\""));
    let chapters = rest.split("<div class=\"chapter\"").skip(1);
    let sections = chapters.flat_map(|chapter| {
        let own = between(chapter, "<section id=\"", "\"");
        let parts = chapter.split_once("<span class=\"parts\">");
        let parts = parts.and_then(|(_, rest)| rest.split_once("</span>"));
        match parts {
            Some((parts, _)) => assert_eq!(between(parts, "href=\"#", "\""), own),
            None => assert_eq!(own.len(), 1, "{own:?}"),
        }
        own
    });
    sections.collect()
}

fn between<'a>(text: &'a str, start: &str, end: &str) -> Vec<&'a str> {
    let starts = text.split(start).skip(1);
    starts
        .filter_map(|rest| Some(rest.split_once(end)?.0))
        .collect()
}

/// Every start tag of a page, in order.
///
/// # Errors
/// Says where an end tag meets another element's start, an element is not closed, or a quote is not.
pub fn start_tags(page: &str) -> Result<Vec<Tag>, String> {
    let mut rest = page;
    let mut open: Vec<String> = Vec::new();
    let mut tags = Vec::new();
    while let Some(start) = rest.find('<') {
        rest = &rest[start + 1..];
        if rest.starts_with('!') {
            continue;
        }
        let end = tag_end(rest).ok_or_else(|| format!("a tag without end: {}", head(rest)))?;
        let (inside, after) = (&rest[..end], &rest[end + 1..]);
        rest = after;
        if let Some(name) = inside.strip_prefix('/') {
            let opened = open.pop();
            if opened.as_deref() != Some(name) {
                return Err(format!("</{name}> closes {opened:?} before {}", head(rest)));
            }
            continue;
        }
        let inside = inside.trim_end_matches('/');
        let name = inside.split_whitespace().next().unwrap_or("").to_string();
        if name == "script" || name == "style" {
            let close = format!("</{name}>");
            let at = rest.find(&close).ok_or("raw text without end")?;
            rest = &rest[at + close.len()..];
        } else if !VOID.contains(&name.as_str()) {
            open.push(name.clone());
        }
        tags.push(Tag {
            attributes: inside[name.len()..].to_string(),
            name,
        });
    }
    if open.is_empty() {
        Ok(tags)
    } else {
        Err(format!("not closed: {open:?}"))
    }
}

/// Position of the `>` that ends a tag, not one within quotes.
fn tag_end(text: &str) -> Option<usize> {
    let mut quoted = false;
    for (position, character) in text.char_indices() {
        match character {
            '"' => quoted = !quoted,
            '>' if !quoted => return Some(position),
            _ => {}
        }
    }
    None
}

fn head(text: &str) -> String {
    text.chars().take(60).collect()
}
