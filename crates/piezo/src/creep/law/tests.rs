use super::Creep;

/// Compares the response with the logarithm over five decades, at times between the fit points.
#[test]
fn five_decades_of_the_logarithm_are_within_a_thousandth_of_the_stroke() {
    for (gamma, least) in [(0.01, 1e-4), (0.02, 2e-4)] {
        let creep = Creep::new(gamma, 0.1, 5).unwrap();
        let mut worst = 0.0_f64;
        for k in 0..=10_000 {
            let t = 0.1 * 10f64.powf(5.0 * f64::from(k) / 10_000.0);
            let law = 1.0 + gamma * (t / 0.1).log10();
            worst = worst.max((creep.response(t) - law).abs());
        }
        assert!(worst < 1e-3 && worst < least, "{worst}");
        // The reported error is that of the fit points.
        assert!((worst - creep.misfit()).abs() < 0.05 * creep.misfit(), "{worst} {}", creep.misfit());
    }
}

/// The fit works for any number of decades and unit of time. All weights are positive and the response is bounded.
#[test]
fn every_range_is_fitted() {
    for decades in 1..=Creep::LONGEST {
        let creep = Creep::new(0.01, 3e-4, decades).unwrap();
        assert!(creep.misfit() < 0.01 * 0.01, "{decades}: {}", creep.misfit());
        assert!(creep.weights().iter().all(|weight| *weight > 0.0));
        assert_eq!(creep.times().len(), decades + 2);
        assert!(
            (creep.direct() - 1.0) / 0.01 < -0.5 && (creep.direct() - 1.0) / 0.01 > -0.6,
            "{decades}: {}",
            creep.direct()
        );
        let end = 3e-4 * 10f64.powi(decades as i32);
        assert!(creep.settled() > creep.response(end) && creep.settled() - creep.response(10.0 * end) < 1e-5);
    }
}

#[test]
fn what_is_out_of_range_is_refused() {
    let said = |creep: Result<Creep, super::CreepError>| creep.unwrap_err().to_string();
    assert!(said(Creep::new(0.0, 0.1, 5)).contains("above 0 and below 0.5 per decade, got 0"));
    assert!(said(Creep::new(f64::NAN, 0.1, 5)).contains("per decade"));
    assert!(said(Creep::new(0.01, 0.0, 5)).contains("time above 0"));
    assert!(said(Creep::new(0.01, 0.1, 7)).contains("1 to 6 decades, got 7"));
}
