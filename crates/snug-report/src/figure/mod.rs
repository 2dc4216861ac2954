//! Still pictures in SVG: axes with round ticks and units, and a few kinds of marks. Colours come from the page's style.

mod axis;
pub(crate) mod group_strip;
mod mark;

pub use axis::{Axis, linear_range, round_step};
pub use mark::{Bar, Cell, Dot, Mark, Segment};

use axis::Tick;
use maud::{Markup, PreEscaped, html};

/// Height of the text below the plot, tick labels and the axis label \[px\]. Chosen.
const BELOW: f64 = 40.0;
/// Height left free above the plot \[px\]. Chosen.
const ABOVE: f64 = 10.0;
/// Width left free to its right \[px\]. Chosen.
const RIGHT: f64 = 20.0;
/// Width of a drawing on a screen as narrow as a telephone's; one that is wider is drawn a second time with this width, so that
/// its text stays as large \[px\].
const NARROW: f64 = 300.0;
/// A drawing is not shrunk below this share of its size, so that its text stays legible; it scrolls instead \[–\]. Chosen.
const SMALLEST: f64 = 0.97;
/// Nor enlarged beyond this one \[–\]. Chosen.
const LARGEST: f64 = 1.15;
/// Least distance of neighbouring tick labels \[px\].
const BETWEEN: f64 = 8.0;
/// Width of one character of a tick label \[px\].
const CHARACTER: f64 = 6.4;

/// One picture: two axes and what is drawn between them.
pub struct Figure {
    /// What it shows, for readers who cannot see it.
    pub description: String,
    /// Width of the drawing \[px at full size\].
    pub width: f64,
    /// Height of the drawing \[px at full size\].
    pub height: f64,
    /// Horizontal axis, from left to right.
    pub x: Axis,
    /// Vertical axis, from bottom to top.
    pub y: Axis,
    /// What is drawn, from back to front.
    pub marks: Vec<Mark>,
}

/// Where data coordinates lie on the drawing.
struct Frame<'a> {
    figure: &'a Figure,
    left: f64,
    width: f64,
}

impl Frame<'_> {
    fn x(&self, value: f64) -> f64 {
        let width = self.width - self.left - RIGHT;
        self.left + self.figure.x.position(value) * width
    }

    fn y(&self, value: f64) -> f64 {
        let height = self.figure.height - ABOVE - BELOW;
        ABOVE + (1.0 - self.figure.y.position(value)) * height
    }

    fn right(&self) -> f64 {
        self.width - RIGHT
    }

    fn bottom(&self) -> f64 {
        self.figure.height - BELOW
    }

    /// The ticks of the horizontal axis that have room beside each other.
    fn columns(&self) -> impl Iterator<Item = &Tick> {
        let ticks = self.figure.x.ticks();
        let room = CHARACTER * self.figure.x.widest_tick() as f64 + BETWEEN;
        let most = ((self.right() - self.left) / room).floor().max(2.0);
        let every = (ticks.len() as f64 / most).ceil().max(1.0) as usize;
        ticks.iter().step_by(every)
    }
}

impl Figure {
    /// The drawing as an `svg` element that scales with its surroundings; a wide one twice, of which the page's style shows the one
    /// for the screen.
    pub fn svg(&self) -> Markup {
        html! {
            @if self.width > LARGEST * NARROW {
                (self.drawn(self.width, "figure broad"))
                (self.drawn(NARROW, "figure narrow"))
            } @else {
                (self.drawn(self.width, "figure"))
            }
        }
    }

    fn drawn(&self, width: f64, class: &str) -> Markup {
        let label_room = if self.y.label.is_empty() { 10.0 } else { 30.0 };
        let frame = Frame {
            figure: self,
            left: label_room + CHARACTER * self.y.widest_tick() as f64,
            width,
        };
        let view_box = format!("0 0 {width} {}", self.height);
        let style = format!(
            "min-width:{:.0}px;max-width:{:.0}px",
            SMALLEST * width.min(NARROW),
            LARGEST * width
        );
        html! {
            svg class=(class) viewBox=(view_box) role="img" aria-label=(self.description) style=(style) {
                title { (self.description) }
                (self.grid(&frame))
                @for mark in &self.marks { (mark.svg(&frame)) }
                (self.labels(&frame))
            }
        }
    }

    fn grid(&self, frame: &Frame) -> Markup {
        let mut lines = String::new();
        for tick in frame.columns() {
            let x = pixel(frame.x(tick.at));
            lines += &format!("M{x} {}V{}", pixel(ABOVE), pixel(frame.bottom()));
        }
        for tick in self.y.ticks().iter().filter(|tick| !tick.heading) {
            let y = pixel(frame.y(tick.at));
            lines += &format!("M{} {y}H{}", pixel(frame.left), pixel(frame.right()));
        }
        html! { path.grid d=(lines) {} }
    }

    fn labels(&self, frame: &Frame) -> Markup {
        // Below the plot's middle, as far as the drawing has room for the words.
        let half = 0.5 * CHARACTER * self.x.label.chars().count() as f64;
        let middle_x = (0.5 * (frame.left + frame.right())).min(frame.width - half);
        let middle_x = middle_x.max(half.min(0.5 * frame.width));
        let middle_y = 0.5 * (ABOVE + frame.bottom());
        let turned = format!("rotate(-90 12 {})", pixel(middle_y));
        html! {
            @for tick in frame.columns() {
                text.tick x=(pixel(frame.x(tick.at))) y=(pixel(frame.bottom() + 15.0)) text-anchor="middle" { (tick.text) }
            }
            @for tick in self.y.ticks() {
                text.tick.heading[tick.heading] x=(pixel(frame.left - 6.0)) y=(pixel(frame.y(tick.at) + 3.8))
                    text-anchor="end" { (tick.text) }
            }
            text.axis x=(pixel(middle_x)) y=(pixel(self.height - 6.0)) text-anchor="middle" { (self.x.label) }
            @if !self.y.label.is_empty() {
                text.axis x="12" y=(pixel(middle_y)) text-anchor="middle" transform=(turned) { (self.y.label) }
            }
        }
    }
}

/// A figure under its heading, with a note below.
pub fn captioned(heading: &str, drawing: Markup, note: Option<&str>) -> Markup {
    html! {
        figure {
            figcaption { (heading) }
            div.drawing { (drawing) }
            @if let Some(note) = note { p.note { (note) } }
        }
    }
}

/// A legend: a swatch and a word per series.
pub fn legend(entries: &[(&str, &str)]) -> Markup {
    html! {
        p.legend {
            @for (class, text) in entries {
                span.key { span.swatch.(class) {} (PreEscaped(" ")) (text) }
            }
        }
    }
}

/// A coordinate with a tenth of a pixel.
fn pixel(value: f64) -> String {
    let text = format!("{value:.1}");
    text.strip_suffix(".0").map_or(text.clone(), String::from)
}
