//! SI units of settings fields, by the name of the field. Settings travel as plain JSON, without units.

/// Unit of a field, `1` when dimensionless; `None` for a name that is not known.
pub(super) fn unit_of(field: &str) -> Option<&'static str> {
    Some(match field {
        "diameter" | "width" | "height" | "thickness" | "spacing" => "m",
        "density" => "kg/m³",
        "viscosity" => "Pa s",
        "duration" | "time_step" | "time_constant" | "delay" => "s",
        // Of a rehearsal, whose value stands for a speed.
        "limit" => "m/s",
        "gravity" => "m/s²",
        "stiffness" => "N/m",
        "porosity"
        | "spacing_over_diameter"
        | "release_height"
        | "artificial_viscosity"
        | "viscosity_constant"
        | "steps_per_contact"
        | "grains_per_side"
        | "layers"
        | "samples"
        | "order"
        | "error"
        | "scale" => "1",
        _ => return None,
    })
}
