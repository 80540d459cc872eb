//! Contact laws.

mod linear_spring_dashpot;

pub use linear_spring_dashpot::LinearSpringDashpot;
