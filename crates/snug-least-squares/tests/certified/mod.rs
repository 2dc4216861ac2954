//! Regression problems with known answers.

pub mod dataset;
pub mod dual;
pub mod models;
pub mod regression;
