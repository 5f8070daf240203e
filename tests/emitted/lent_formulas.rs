//! The constants `DERIVATION` are the documents of the compiler: equal formulas, in Unicode, LaTeX and MathML.
//!
//! `MECHANISM=four_bar cargo test --all-features --test emitted lent_formulas` compares one mechanism, by its file or its name.

use linkage::derivation::{Derivation, Kernel, KernelCode, SceneDerivation};
use linkage::{Document, sheet::Sheet};
use linkage_gallery::checks::each;
use linkage_gallery::listed::all;
use linkage_gallery::{five_bar_scenes, four_bar_effects, slider_crank_scenes, source};

/// The functions without their code, which these files do not request.
fn without_code(kernels: &[Kernel<'static>]) -> &'static [Kernel<'static>] {
    kernels.iter().map(|kernel| Kernel { code: KernelCode::NONE, ..*kernel }).collect::<Vec<_>>().leak()
}

fn is_lent(file: &str, emitted: &Derivation) {
    let mechanism = linkage_compiler::read(source::tokens_of(file)).unwrap().remove(0);
    let (documents, _) = linkage_compiler::documents(&mechanism).unwrap();
    let document = documents.iter().find(|document| document.mechanism == emitted.mechanism).unwrap();
    let lent = linkage_lent::derivation(document);
    let lent = Derivation { kernels: without_code(lent.kernels), ..lent };
    assert_eq!(*emitted, lent);
    assert_eq!(emitted.to_text(), lent.to_text());
    assert_eq!(emitted.to_latex(), lent.to_latex());
    assert_eq!(Sheet::new(emitted).to_html(), Sheet::new(&lent).to_html());
}

#[test]
fn mechanisms() {
    each(all(), |of| is_lent(of.file(), of.derivation()));
}

#[test]
fn scenes() {
    for (file, emitted) in [
        ("four_bar_effects", four_bar_effects::Everything::<f64>::DERIVATION),
        ("slider_crank_scenes", slider_crank_scenes::Turning::<f64>::DERIVATION),
        ("slider_crank_scenes", slider_crank_scenes::Worn::<f64>::DERIVATION),
        ("five_bar_scenes", five_bar_scenes::Free::<f64>::DERIVATION),
    ] {
        let mechanism = linkage_compiler::read(source::tokens_of(file)).unwrap().remove(0);
        let (_, documents) = linkage_compiler::documents(&mechanism).unwrap();
        let document = documents.iter().find(|document| document.scene == emitted.scene).unwrap();
        let lent = linkage_lent::scene(document);
        let lent = SceneDerivation { kernels: without_code(lent.kernels), ..lent };
        assert_eq!(*emitted, lent);
        assert_eq!(emitted.to_latex(), lent.to_latex());
    }
}
