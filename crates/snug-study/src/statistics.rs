//! The tables of the thesis and what a reviewer would ask for, put together from `snug-statistics`.

mod assumptions;
mod conditions;
mod factor;
mod hypothesis_tests;
mod methods;
mod quantity;
mod sample;
mod stated;

pub use conditions::summaries;
pub use hypothesis_tests::rows;
