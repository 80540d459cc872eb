//! kynch: what is asked, run, kept, judged and shown.
//!
//! `study → store → runner`; `reference`, `judge` and `report` never see the runner or the simulator.

pub mod cli;
pub mod export;
pub mod judge;
pub mod reference;
pub mod report;
pub mod runner;
pub mod store;
pub mod study;
