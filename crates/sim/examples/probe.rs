use kynch_sim::outcome::Control;
use kynch_sim::scene::*;
use std::time::Instant;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let get = |k: &str, d: f64| {
        a.iter()
            .find_map(|x| x.strip_prefix(&format!("{k}=")).map(|v| v.parse().unwrap()))
            .unwrap_or(d)
    };
    let s = get("s", 2.0);
    let eps = get("eps", 0.0);
    let mut scheme = Scheme::default();
    if get("c", 0.0) > 0.0 {
        scheme.sound_speed = SoundSpeed::Value(get("c", 0.0));
    }
    if get("dt", 0.0) > 0.0 {
        scheme.time_step = Some(get("dt", 0.0));
    }
    if get("plain", 0.0) > 0.0 {
        scheme.sharpening = SharpeningChoice::None;
    }
    if get("carried", 0.0) > 0.0 {
        scheme.hydrostatics = Hydrostatics::Carried;
    }
    let w = get(
        "w",
        if s == 1.5 {
            4.5e-3
        } else if s == 3.0 {
            4.2e-3
        } else if s == 6.0 {
            if eps == 0.8 { 6.0e-3 } else { 5.4e-3 }
        } else {
            4e-3
        },
    );
    let fluid = Fluid::Sph(SphFluid {
        medium: Medium {
            density: 1000.,
            viscosity: get("mu", 0.89e-3),
        },
        spacing_over_diameter: s,
        scheme,
    });
    let grains = Grains {
        diameter: 1e-4,
        density: 2500.,
    };
    let column = Column {
        width: w,
        height: get("H", 6e-3),
    };
    let scene = if eps > 0.0 {
        let v = std::f64::consts::PI / 6.0 * 1e-12;
        let p = (v / (1.0 - eps)).cbrt();
        Scene::ConstantPorosityBlock(ConstantPorosityBlock {
            grains,
            drag: Drag::DiFelice,
            fluid,
            column,
            porosity: eps,
            grains_per_side: (w / p).round() as u32,
            layers: (2.2e-3 / p).round() as u32,
            held: get("held", 0.0) > 0.0,
            duration: get("T", 0.06),
            gravity: 9.81,
        })
    } else {
        Scene::SingleSphere(SingleSphere {
            grains,
            drag: Drag::Stokes,
            fluid,
            column,
            release_height: get("z", 0.8),
            coupling: if get("one", 0.0) > 0.0 {
                Coupling::OneWay
            } else {
                Coupling::TwoWay
            },
            self_disturbance: if get("raw", 0.0) > 0.0 {
                SelfDisturbance::Uncorrected
            } else {
                SelfDisturbance::Corrected
            },
            duration: get("T", 0.0625),
            gravity: 9.81,
        })
    };
    let t = Instant::now();
    let o = run(&scene, &Control::SILENT);
    let o = match o {
        Ok(o) => o,
        Err(e) => {
            println!("FAIL {} {:?}", e.reason, e.kind);
            e.partial
        }
    };
    let set = setup::Settling::of(&scene);
    let reff = set.expected_speed();
    print!(
        "s={s} eps={eps} wall {:.2}s steps {} ",
        t.elapsed().as_secs_f64(),
        o.counters.steps
    );
    for x in &o.scalars {
        if [
            "terminal_velocity",
            "terminal_velocity_drift",
            "momentum_error",
            "self_disturbance_error",
            "disturbance",
            "sound_speed",
            "spurious_velocity",
        ]
        .contains(&x.name)
        {
            print!("{}={:.4e} ", x.name, x.value);
        }
    }
    let v = o
        .scalars
        .iter()
        .find(|x| x.name == "terminal_velocity")
        .map(|x| x.value)
        .unwrap_or(f64::NAN);
    println!("\n   err vs ref {:.3}%", 100.0 * (v / reff - 1.0));
    if eps == 0.0 {
        let se = &o.tables[0];
        let col = |n: &str| &se.columns.iter().find(|c| c.name == n).unwrap().values;
        let td = set.relaxation_time();
        let m = col("time")
            .iter()
            .zip(col("velocity"))
            .map(|(t, v)| (v - reff * (1.0 - (-t / td).exp())).abs() / reff)
            .fold(0.0, f64::max);
        println!("   startup max err {:.3}%", 100.0 * m);
        if get("print", 0.0) > 0.0 {
            let n = col("time").len();
            for i in (0..n).step_by((n / 25).max(1)) {
                println!(
                    "{:.4e} v {:.5} ref {:.5} dist {:.5} own {:.5} stress {:.4}",
                    col("time")[i],
                    col("velocity")[i] / reff,
                    1.0 - (-col("time")[i] / td).exp(),
                    col("disturbance")[i] / reff,
                    col("disturbance_analytic")[i] / reff,
                    col("stress_force")[i] / 7.7e-9
                );
            }
        }
    } else if get("print", 0.0) > 0.0 {
        let se = &o.tables[0];
        let n = se.columns[0].values.len();
        for i in (0..n).step_by((n / 25).max(1)) {
            println!(
                "{:.4e} {:.5}",
                se.columns[0].values[i],
                se.columns[1].values[i] / reff
            );
        }
        for t in &o.tables[1..] {
            println!("{}", t.name);
            for i in 0..t.columns[0].values.len() {
                for c in &t.columns {
                    print!("{:.4e} ", c.values[i]);
                }
                println!();
            }
        }
    }
}
