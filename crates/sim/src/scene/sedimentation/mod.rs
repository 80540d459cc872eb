//! Many grains settle onto the floor of a box.

mod model;

pub use model::{
    Arrangement, Cohesion, Container, Detection, Dimensions, Floor, GrainClass, GrainDrag, Lift,
    Sedimentation, Sides, SlicePorosity, StillFluid, Until, Voidage,
};
