//! What a figure draws on its axes (lines, bands, dots, bars), as SVG; what is not finite is left out.

use super::{Frame, pixel};
use maud::{Markup, html};

/// A point, in the units of the axes, with the text shown under the pointer.
pub struct Dot {
    /// Horizontal coordinate.
    pub x: f64,
    /// Vertical coordinate.
    pub y: f64,
    /// Text under the pointer; none when empty.
    pub title: String,
}

/// A filled rectangle between two corners, in the units of the axes.
pub struct Bar {
    /// Left and right end.
    pub x: (f64, f64),
    /// Lower and upper end.
    pub y: (f64, f64),
    /// Text under the pointer; none when empty.
    pub title: String,
}

/// A rectangle that can be chosen.
pub struct Cell {
    /// What is drawn.
    pub bar: Bar,
    /// What it stands for, as a script reads it from `data-cell`.
    pub key: String,
}

/// A straight line between two points, in the units of the axes.
pub struct Segment {
    /// Horizontal coordinates of its ends.
    pub x: (f64, f64),
    /// Vertical coordinates of its ends.
    pub y: (f64, f64),
}

/// One layer of a figure: the class that names its colour in the page's style, and what is drawn.
pub enum Mark {
    /// A line through points in order; `None` breaks it.
    Line(&'static str, Vec<Option<(f64, f64)>>),
    /// The area between a lower and an upper edge, both from left to right.
    Band(&'static str, Vec<(f64, f64)>, Vec<(f64, f64)>),
    /// Points.
    Dots(&'static str, Vec<Dot>),
    /// Rectangles.
    Bars(&'static str, Vec<Bar>),
    /// Rectangles that can be chosen.
    Cells(&'static str, Vec<Cell>),
    /// Straight lines, for whiskers and rules.
    Segments(&'static str, Vec<Segment>),
}

impl Mark {
    /// A single straight line between two points, in the units of the axes.
    pub fn rule(class: &'static str, x: (f64, f64), y: (f64, f64)) -> Self {
        Self::Segments(class, vec![Segment { x, y }])
    }

    pub(super) fn svg(&self, frame: &Frame) -> Markup {
        match self {
            Self::Line(class, points) => html! {
                path.line.(class) d=(line_path(points, frame)) {}
            },
            Self::Band(class, low, high) => html! {
                path.area.(class) d=(area_path(low, high, frame)) {}
            },
            Self::Dots(class, dots) => html! {
                g.dots.(class) {
                    @for dot in dots.iter().filter(|dot| finite(&[dot.x, dot.y])) {
                        circle cx=(pixel(frame.x(dot.x))) cy=(pixel(frame.y(dot.y))) r="3.2" {
                            @if !dot.title.is_empty() { title { (dot.title) } }
                        }
                    }
                }
            },
            Self::Bars(class, bars) => html! {
                g.bars.(class) { @for bar in bars.iter().filter(|bar| bar.is_finite()) { (bar_svg(bar, None, frame)) } }
            },
            Self::Cells(class, cells) => html! {
                g.bars.(class) {
                    @for cell in cells.iter().filter(|cell| cell.bar.is_finite()) { (bar_svg(&cell.bar, Some(&cell.key), frame)) }
                }
            },
            Self::Segments(class, segments) => html! {
                path.segments.(class) d=(segment_path(segments, frame)) {}
            },
        }
    }
}

impl Bar {
    fn is_finite(&self) -> bool {
        finite(&[self.x.0, self.x.1, self.y.0, self.y.1])
    }
}

/// What has no place on the drawing is not drawn.
fn finite(coordinates: &[f64]) -> bool {
    coordinates.iter().all(|coordinate| coordinate.is_finite())
}

fn line_path(points: &[Option<(f64, f64)>], frame: &Frame) -> String {
    let mut path = String::new();
    let mut broken = true;
    for point in points {
        let Some((x, y)) = point.filter(|(x, y)| x.is_finite() && y.is_finite()) else {
            broken = true;
            continue;
        };
        path.push(if broken { 'M' } else { 'L' });
        path += &format!("{} {}", pixel(frame.x(x)), pixel(frame.y(y)));
        broken = false;
    }
    path
}

/// Along the upper edge and back along the lower one.
fn area_path(low: &[(f64, f64)], high: &[(f64, f64)], frame: &Frame) -> String {
    let around: Vec<Option<(f64, f64)>> = high
        .iter()
        .chain(low.iter().rev())
        .filter(|(x, y)| finite(&[*x, *y]))
        .copied()
        .map(Some)
        .collect();
    let path = line_path(&around, frame);
    if path.is_empty() { path } else { path + "Z" }
}

fn segment_path(segments: &[Segment], frame: &Frame) -> String {
    segments
        .iter()
        .filter(|segment| finite(&[segment.x.0, segment.x.1, segment.y.0, segment.y.1]))
        .map(|segment| {
            format!(
                "M{} {}L{} {}",
                pixel(frame.x(segment.x.0)),
                pixel(frame.y(segment.y.0)),
                pixel(frame.x(segment.x.1)),
                pixel(frame.y(segment.y.1))
            )
        })
        .collect()
}

fn bar_svg(bar: &Bar, key: Option<&str>, frame: &Frame) -> Markup {
    let (left, right) = (frame.x(bar.x.0), frame.x(bar.x.1));
    let (top, bottom) = (frame.y(bar.y.1), frame.y(bar.y.0));
    html! {
        rect x=(pixel(left)) y=(pixel(top)) width=(pixel((right - left).max(0.0))) height=(pixel((bottom - top).max(0.0))) data-cell=[key] {
            @if !bar.title.is_empty() { title { (bar.title) } }
        }
    }
}
