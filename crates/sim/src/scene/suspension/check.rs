//! What of a suspension cannot be simulated.

use super::model::Suspension;
use super::observe::MOST_CLASSES;
use crate::scene::check::List;

pub fn check(scene: &Suspension, list: &mut List) {
    if !(1..=MOST_CLASSES).contains(&scene.classes.len()) {
        let message = format!("there are {} classes, one to four are known", scene.classes.len());
        list.add(
            "classes",
            message,
            "leave out, or put together, what hardly differs",
        );
    }
}
