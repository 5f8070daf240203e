//! Mechanisms without certificates: each says why.

use linkage::certify::Certify;
use linkage::{D, Mechanism};
use linkage_gallery::cam_rocker::CamRocker;
use linkage_interpreter::NotPrepared;

use super::{certifiable, coordinates, only};
use linkage_interpreter::CertifiableAtRunTime;

#[test]
fn user_functions() {
    certifiable::<1, CamRocker, _>(|own| {
        let start = coordinates::<CertifiableAtRunTime<'_, _>>(&[vec![1.3, 0.2, 1.4], vec![0.1]]);
        let error = Certify::new(own).turn(&start).map(|_| ()).expect_err("nothing is known of the cam");
        let expected = "group psi of CamRocker has the user function turn, which has no values over intervals";
        assert_eq!(error.to_string(), expected);
        assert_eq!(own.name(), "CamRocker");
    });
}

#[test]
fn a_text_without_formulas() {
    let text = "mechanism Crank { param r = 2; input phi; unknown x; equation x = r * cos(phi); }";
    let (without, with) = (only(text), only(&text.replace("; }", "; derive intervals; }")));
    let error = without.design().prepared().expect("a mechanism").certifiable::<D<1>>().map(|_| ()).expect_err("none");
    assert_eq!(error, NotPrepared::NoFormulas { mechanism: "Crank".to_owned() });
    let expected = "`Crank` has no formulas over intervals: add `derive intervals;` to its mechanism";
    assert_eq!(error.to_string(), expected);
    let design = with.design();
    let prepared = design.prepared().expect("a mechanism");
    assert!(prepared.certifiable::<D<1>>().is_ok());
    let error = prepared.certifiable::<D<2>>().map(|_| ()).expect_err("one input");
    assert_eq!(error, NotPrepared::Inputs { count: 1 });
}

/// Other algorithms take a mechanism with more parameters.
#[test]
fn a_mechanism_with_too_many_parameters() {
    let of = |count: usize| {
        let names: Vec<String> = (0..count).map(|place| format!("p{place}")).collect();
        let all = names.iter().map(|name| format!("{name} = 1")).collect::<Vec<_>>().join(", ");
        let sum = names.join(" + ");
        only(&format!(
            "mechanism M {{ param {all}; input phi; unknown x; equation x = ({sum}) * cos(phi); derive intervals; }}"
        ))
    };
    let [most, more] = [64, 65].map(|count| of(count).design());
    assert!(most.prepared().expect("a mechanism").certifiable::<D<1>>().is_ok());
    let prepared = more.prepared().expect("a mechanism");
    assert!(prepared.with_inputs::<D<1>>().is_ok());
    let error = prepared.certifiable::<D<1>>().map(|_| ()).expect_err("too many");
    assert_eq!(error, NotPrepared::TooLarge { of: "parameters", count: 65, most: 64 });
}
