//! Cuts an expression into numbers, names and symbols.

use super::Fault;

/// One piece of an expression's text.
#[derive(Debug, Clone, PartialEq)]
pub enum Token<'a> {
    Number(f64),
    Name(&'a str),
    /// One of `+ - * / ^ ( ) ,`.
    Symbol(char),
    End,
}

impl Token<'_> {
    /// As an error shows it.
    pub fn shown(&self) -> String {
        match self {
            Self::Number(value) => format!("the number {value}"),
            Self::Name(name) => format!("`{name}`"),
            Self::Symbol(symbol) => format!("`{symbol}`"),
            Self::End => "the end".to_owned(),
        }
    }
}

/// Takes the tokens off an expression's text one after the other.
pub struct Tokens<'a> {
    text: &'a str,
    /// Byte at which the rest begins.
    at: usize,
}

impl<'a> Tokens<'a> {
    pub fn new(text: &'a str) -> Self {
        Self { text, at: 0 }
    }

    /// The next token and the character, counted from 1, at which it begins.
    pub fn next(&mut self) -> Result<(Token<'a>, usize), Fault> {
        let rest = self.text[self.at..].trim_start();
        self.at = self.text.len() - rest.len();
        let position = self.text[..self.at].chars().count() + 1;
        let Some(first) = rest.chars().next() else {
            return Ok((Token::End, position));
        };
        let (token, length) = match first {
            '0'..='9' | '.' => number(rest, position)?,
            'a'..='z' | 'A'..='Z' => {
                let end = rest
                    .find(|letter: char| !letter.is_ascii_alphanumeric() && letter != '_')
                    .unwrap_or(rest.len());
                (Token::Name(&rest[..end]), end)
            }
            '+' | '-' | '*' | '/' | '^' | '(' | ')' | ',' => (Token::Symbol(first), 1),
            other => {
                return Err(Fault {
                    position,
                    found: format!("`{other}`"),
                    allowed: "numbers, names, + - * / ^ and parentheses".to_owned(),
                });
            }
        };
        self.at += length;
        Ok((token, position))
    }
}

/// Digits with at most one point, and an exponent if one follows.
fn number(rest: &str, position: usize) -> Result<(Token<'static>, usize), Fault> {
    let bytes = rest.as_bytes();
    let mut end = bytes
        .iter()
        .take_while(|byte| byte.is_ascii_digit() || **byte == b'.')
        .count();
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let digits = bytes[end + 1 + sign..]
            .iter()
            .take_while(|byte| byte.is_ascii_digit())
            .count();
        if digits > 0 {
            end += 1 + sign + digits;
        }
    }
    match rest[..end].parse::<f64>() {
        Ok(value) if value.is_finite() => Ok((Token::Number(value), end)),
        _ => Err(Fault {
            position,
            found: format!("`{}`", &rest[..end]),
            allowed: "a number such as 2, 0.5 or 1e-3".to_owned(),
        }),
    }
}
