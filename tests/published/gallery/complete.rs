//! A mechanism of the gallery without a point, an output or a default is named with its file when the gallery is compiled.

#[path = "../../../dev/gallery/build/complete.rs"]
mod check;

use linkage_gallery::source;

#[test]
fn what_is_missing_is_named() {
    let text = "use linkage::linkage; linkage! { mechanism Lame {
        param a = 1, long_arm;
        input phi;
        equation long_arm * x = a * cos(phi);
        unknown x;
    } }";
    let needed = "the tests of all mechanisms need it";
    let expected = [
        format!("src/lame.rs: mechanism Lame has no point: write `point P = ..;`; {needed}"),
        format!("src/lame.rs: mechanism Lame has no output: write `output o = ..;`; {needed}"),
        format!(
            "src/lame.rs: mechanism Lame has no default for the parameter `long_arm`: write `param long_arm = 1`; {needed}"
        ),
    ];
    assert_eq!(check::missing("src/lame.rs", text), expected);
}

#[test]
fn a_complete_mechanism_lacks_nothing() {
    assert_eq!(check::missing("four_bar.rs", source::text_of("four_bar")), [""; 0]);
    assert_eq!(check::of_folder(&source::folder()), [""; 0]);
}
