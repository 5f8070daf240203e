//! The constants `DERIVATION` are the documents of the compiler: equal formulas, in Unicode, LaTeX and MathML.
//!
//! `MECHANISM=four_bar cargo test --all-features --test emitted lent_formulas` compares one mechanism, by its file or its name.

use linkage::derivation::{Derivation, Kernel, KernelCode, SceneDerivation, SheetDerivation};
use linkage::{Document, sheet::Sheet};
use linkage_gallery::checks::each;
use linkage_gallery::listed::all;
use linkage_gallery::{five_bar_scenes, four_bar_effects, slider_crank_scenes, source};
use linkage_report::lend::Lender;

/// The functions without their code, which these files do not request.
fn without_code<'a>(kernels: &[Kernel<'a>]) -> Vec<Kernel<'a>> {
    kernels.iter().map(|kernel| Kernel { code: KernelCode::NONE, ..*kernel }).collect()
}

fn is_lent(file: &str, emitted: &Derivation) {
    let mechanism = linkage_compiler::read(source::tokens_of(file)).unwrap().remove(0);
    let (documents, _) = linkage_compiler::documents(&mechanism).unwrap();
    let document = documents.iter().find(|document| document.record.mechanism == emitted.mechanism).unwrap();
    let lender = Lender::default();
    let lent = lender.derivation(document).unwrap();
    let kernels = without_code(lent.kernels);
    let lent = Derivation { kernels: &kernels, ..lent };
    assert_eq!(format!("{emitted:?}"), format!("{lent:?}"));
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
        let document = documents.iter().find(|document| document.record.scene == emitted.scene).unwrap();
        let lender = Lender::default();
        let lent = lender.scene(document).unwrap();
        let kernels = without_code(lent.kernels);
        let lent = SceneDerivation { kernels: &kernels, ..lent };
        assert_eq!(format!("{emitted:?}"), format!("{lent:?}"));
        assert_eq!(emitted.to_latex(), lent.to_latex());
    }
}

macro_rules! with_source {
    ($($tokens:tt)*) => {
        linkage::linkage! { $($tokens)* }

        const SOURCE: &str = stringify!($($tokens)*);
    };
}

with_source! {
    /// A slider-crank with a point off the rod, whose choice of input is open.
    pub mechanism Sheets {
        param r = 1, l = 3, e = 0.2, w = 0.5;
        coordinate phi, psi, s;
        loop r@phi + l@psi = (s, e);
        point Pin = r@phi;
        point Beside = Pin + (l/2, w)@psi;
        drive Crank by phi;
        drive Piston by s;
        derive sheet;
    }
}

/// The constants `SHEET` are the documents of the compiler, and a page shows them, also with numbers.
#[test]
fn sheets() {
    let mechanism = linkage_compiler::read(SOURCE.parse().unwrap()).unwrap().remove(0);
    let documents = linkage_compiler::sheets(&mechanism).unwrap();
    let emitted: [(&Derivation<'_>, &SheetDerivation<'_>); 2] =
        [(Crank::<f64>::DERIVATION, Crank::<f64>::SHEET), (Piston::<f64>::DERIVATION, Piston::<f64>::SHEET)];
    assert_eq!(documents.len(), emitted.len());
    for (document, (derivation, emitted)) in documents.iter().zip(emitted) {
        let lender = Lender::default();
        let lent = lender.sheet(document).unwrap();
        assert_eq!(format!("{emitted:?}"), format!("{lent:?}"));
        assert_eq!((emitted.to_text(), emitted.to_latex()), (lent.to_text(), lent.to_latex()));
        let pages = [Sheet::new(derivation).by_hand(emitted).to_html(), {
            let derivations = linkage_compiler::documents(&mechanism).unwrap().0;
            let of = derivations.iter().find(|of| of.record.mechanism == derivation.mechanism).unwrap();
            Sheet::new(&lender.derivation(of).unwrap()).by_hand(&lent).to_html()
        }];
        // The derivation of `documents` has the formulas of functions too, which a page does not show.
        assert_eq!(pages[0], pages[1]);
        let latex = emitted.to_latex();
        for (opening, closing) in [("{", "}"), ("\\begin", "\\end"), ("\\[", "\\]")] {
            assert_eq!(latex.matches(opening).count(), latex.matches(closing).count(), "{opening}");
        }
    }
    insta::with_settings!({ omit_expression => true }, {
        insta::assert_snapshot!("sheet_in_text", Crank::<f64>::SHEET.to_text());
        insta::assert_snapshot!("sheet_in_latex", Piston::<f64>::SHEET.to_latex());
    });
}
