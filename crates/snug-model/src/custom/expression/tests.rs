//! Expressions against closed forms, their derivatives, their temporaries, and what is said of those that cannot be read.

#![allow(clippy::unwrap_used)]

use super::name::Function;
use super::*;
use crate::law::Instant;
use crate::numeric::dual::Dual;
use crate::numeric::number::Number;

const PARAMETERS: [&str; 2] = ["p", "q"];

fn surroundings<N: Number>(x_m: N, v_m_per_s: N) -> Instant<N> {
    Instant {
        torque_nm: x_m.constant(12.0),
        x_m,
        v_m_per_s,
        since_onset_s: x_m.value().constant(0.07),
        lever_arm_m: x_m.value().constant(0.25),
    }
}

/// Its value at p = 1.5, q = −0.4, x = 0.3, v = −0.8, T = 12, t = 0.07, l = 0.25, a = 7.
fn value(text: &str) -> f64 {
    let program = compile(text, &PARAMETERS, &Variable::ALL).unwrap();
    program.evaluate(
        &[1.5, -0.4],
        &Surroundings {
            at: &surroundings(0.3, -0.8),
            acceleration_rad_per_s2: Some(7.0),
        },
    )
}

#[test]
fn expressions_have_the_values_they_have_by_hand() {
    let cases = [
        ("p*x^2*v", 1.5 * 0.09 * -0.8),
        ("2+3*4^2/8-1", 7.0),
        ("2^3^2", 512.0),
        ("-x^2", -0.09),
        ("(-x)^2", 0.09),
        ("2^-2", 0.25),
        ("8 - 4 - 2", 2.0),
        ("8 / 4 / 2", 1.0),
        ("- - x", 0.3),
        ("+x - -v", -0.5),
        ("1.5e-3 + .5E1 + 2.", 7.0015),
        ("x^1 + x^0", 1.3),
        ("x^0.5", 0.3_f64.sqrt()),
        ("abs(v)^p * sign(v)", -(0.8_f64.powf(1.5))),
        ("theta - x/l", 0.0),
        ("omega", -3.2),
        ("T*t + a", 7.84),
        ("sin(pi/6) + cos(pi/3) + tan(pi/4)", 2.0),
        ("exp(log(x)) + sqrt(abs(-4))", 2.3),
        (
            "tanh(v/0.1) + atan(1)",
            (-8.0_f64).tanh() + std::f64::consts::FRAC_PI_4,
        ),
        ("min(x, v) + 10*max(q, p)", 14.2),
        ("step(x) + step(v) + step(0)", 1.0),
        ("smooth_step(x) + smooth_step(7)", 1.0 + 0.09 * 2.4),
        ("1/(x - v)", 1.0 / 1.1),
        ("((((p))))", 1.5),
        ("(x+v)*(x-v)/(p+q)-(p*(q+(x*(v+p))))", {
            (-0.5 * 1.1) / 1.1 - 1.5 * (-0.4 + 0.3 * 0.7)
        }),
    ];
    for (text, expected) in cases {
        let found = value(text);
        assert!(
            (found - expected).abs() < 1e-13,
            "{text}: {found} against {expected}"
        );
    }
}

#[test]
fn slopes_are_those_of_central_differences() {
    let texts = [
        "p*x^2*v",
        "x^-3 / (1 + v^2) - q",
        "abs(v)^p * sign(v) + x^0.7 + x^p",
        "sin(q*x) * cos(v) + tan(x/2) - atan(v*p)",
        "exp(-p*x) * log(x + 2) + sqrt(x) + tanh(v/p)",
        "min(x, p)*max(v, q) + smooth_step(x/p) + abs(v)*omega - theta*x*T",
        "3 - 2*(p - x*(v - q*(x + 4)))/(p*q)",
    ];
    let point = [1.5, -0.4, 0.3, -0.8];
    for text in texts {
        let program = compile(text, &PARAMETERS, &Variable::ALL[..7]).unwrap();
        let at = |[p, q, x, v]: [f64; 4]| {
            let around = Surroundings {
                at: &surroundings(x, v),
                acceleration_rad_per_s2: None,
            };
            program.evaluate(&[p, q], &around)
        };
        let [p, q, x, v] = std::array::from_fn(|index| Dual::<4>::parameter(point[index], index));
        let around = Surroundings {
            at: &surroundings(x, v),
            acceleration_rad_per_s2: None,
        };
        let dual = program.evaluate(&[p, q], &around);
        assert!((dual.value - at(point)).abs() < 1e-13 * (1.0 + dual.value.abs()));
        for index in 0..4 {
            let moved = |step: f64| {
                let mut moved = point;
                moved[index] += step;
                at(moved)
            };
            let difference = (moved(1e-6) - moved(-1e-6)) / 2e-6;
            let slope = dual.partials[index];
            assert!(
                (slope - difference).abs() < 1e-8 * (1.0 + slope.abs()),
                "{text}, variable {index}: {slope} against {difference}"
            );
        }
    }
}

#[test]
fn a_root_at_rest_keeps_its_slopes_finite() {
    for text in [
        "sqrt(abs(v))*sign(v)",
        "abs(v)^0.5",
        "p*abs(v)^q",
        "abs(v)^(p/10)",
    ] {
        let program = compile(text, &PARAMETERS, &Variable::ALL).unwrap();
        let [p, q, v] =
            [(1.5, 0), (0.6, 1), (0.0, 2)].map(|(at, index)| Dual::<3>::parameter(at, index));
        let around = Surroundings {
            at: &surroundings(Dual::from(0.1), v),
            acceleration_rad_per_s2: None,
        };
        let dual = program.evaluate(&[p, q], &around);
        assert_eq!(dual.value, 0.0, "{text}");
        assert!(
            dual.partials.iter().all(|slope| slope.is_finite()),
            "{text}: {dual:?}"
        );
    }
}

#[test]
fn constants_cost_nothing() {
    let program = |text| compile(text, &PARAMETERS, &Variable::ALL).unwrap();
    assert_eq!(program("p * (2^3 - sin(0)*4)"), program("p*8"));
    assert_eq!(program("3 * 4 / exp(0)"), program("12"));
    assert_eq!(program("x^(1+1)"), program("x^2"));
}

#[test]
fn what_cannot_be_read_says_where_and_what_is_allowed() {
    let cases = [
        ("", 1, "the end", "a number, a name or `(`"),
        ("p*x^^2", 5, "`^`", "a number, a name or `(`"),
        ("p*x 2", 5, "the number 2", "+ - * / ^ or the end"),
        ("2x", 2, "`x`", "+ - * / ^ or the end"),
        ("(p*x", 5, "the end", "+ - * / ^ or `)`"),
        ("p*x)", 4, "`)`", "+ - * / ^ or the end"),
        ("p·x", 2, "`·`", "numbers, names, + - * / ^ and parentheses"),
        ("1.2.3*x", 1, "`1.2.3`", "a number such as 2, 0.5 or 1e-3"),
        ("1e999", 1, "`1e999`", "a number such as 2, 0.5 or 1e-3"),
        ("sin x", 5, "`x`", "`(` after the function `sin`"),
        ("min(x)", 6, "`)`", "`,`: the function takes two values"),
        ("sin(x, v)", 6, "`,`", "+ - * / ^ or `)`"),
    ];
    for (text, position, found, allowed) in cases {
        let fault = compile(text, &PARAMETERS, &Variable::ALL).unwrap_err();
        let expected = Fault {
            position,
            found: found.to_owned(),
            allowed: allowed.to_owned(),
        };
        assert_eq!(fault, expected, "{text}");
    }
    let fault = compile("p*y", &PARAMETERS, &Variable::ALL[..7]).unwrap_err();
    assert_eq!((fault.position, fault.found.as_str()), (3, "`y`"));
    for known in ["p, q", "x, v, T, t, theta, omega, l)", "smooth_step", "pi"] {
        assert!(fault.allowed.contains(known), "{}", fault.allowed);
    }
    assert!(
        compile("a", &[], &Variable::ALL[..7]).is_err(),
        "the sensor's own"
    );
}

#[test]
fn endless_nesting_is_refused_and_no_text_panics() {
    let nested = |text: &str, count: usize| text.repeat(count);
    for text in [
        nested("(", 900),
        nested("-", 900),
        nested("2^", 480),
        nested("sin(", 240),
        nested("x+", 600),
        nested("(x*v+", 199) + "x" + &nested(")", 199),
    ] {
        assert!(compile(&text, &PARAMETERS, &Variable::ALL).is_err());
    }
    let long = nested("x+", 490) + "x";
    assert!(compile(&long, &PARAMETERS, &Variable::ALL).is_ok());
    // Every text of three pieces: each is read or refused, none panics.
    let pieces = [
        "p", "x", "2", "1e", "+", "-", "*", "/", "^", "(", ")", ",", "sin", "min(", " ", "ß", ".",
    ];
    for first in pieces {
        for second in pieces {
            for third in pieces {
                let _ = compile(
                    &format!("{first}{second}{third}"),
                    &PARAMETERS,
                    &Variable::ALL,
                );
            }
        }
    }
}

#[test]
fn names_of_the_language_are_reserved() {
    for name in ["x", "T", "pi", "sin", "smooth_step", "a"] {
        assert!(is_reserved(name), "{name}");
    }
    assert!(!is_reserved("p") && !is_reserved("tau_s"));
    assert!(
        is_name("k3_n_per_m3")
            && !is_name("3k")
            && !is_name("_k")
            && !is_name("k-3")
            && !is_name("")
    );
    assert_eq!(
        Function::ALL.map(Function::name).map(Function::named),
        Function::ALL.map(Some)
    );
}
