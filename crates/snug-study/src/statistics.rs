//! The tables of the thesis and what a reviewer would ask for, put together from `snug-statistics`.

mod conditions;
mod factor;
mod quantity;
mod tests;

pub use conditions::summaries;
pub use tests::rows;
