//! Names as they are written: capitals, names of several words, words of Rust. All answers are those of a text with small names.

use super::folder::Folder;

const SMALL: &str = "mechanism Bar {
    param lg = 4, type_b = 1, c = 3;
    input th;
    unknown pa, qb;
    loop type_b@th + c@pa = lg@0 + c@qb;
    point b = type_b@th;
    point p = b + c@pa;
    output mue = qb - pa + lg - 4;
    output arm = atan2(c*sin(pa), c*cos(pa)) - th;
    body rod { mass lg; inertia c; center p; angle pa; }
    scene drop { gravity (0, -9.81); inertia; equilibrium; }
}";

/// Each name in capitals, with its field, the same name in small letters.
const NAMES: [(&str, &str); 10] = [
    ("lg", "LG"),
    ("type_b", "Type_B"),
    ("c", "C"),
    ("th", "TH"),
    ("pa", "Pa"),
    ("qb", "QB"),
    ("b", "B"),
    ("p", "P"),
    ("mue", "MUE"),
    ("arm", "ARM"),
];

/// A text with names in capitals.
fn capital(text: &str) -> String {
    let mut written = String::new();
    let mut word = String::new();
    for letter in text.chars().chain(['\n']) {
        if letter.is_alphanumeric() || letter == '_' {
            word.push(letter);
            continue;
        }
        let name = NAMES.iter().find(|(small, _)| *small == word);
        written += name.map_or(word.as_str(), |(_, large)| large);
        word.clear();
        written.push(letter);
    }
    written.trim_end().to_owned()
}

#[test]
fn all_answers_are_those_of_small_names() {
    let folder = Folder::new();
    folder.write("small.linkage", SMALL);
    folder.write("large.linkage", capital(SMALL));
    let at = "--at th=50deg";
    for command in [
        "names small.linkage".to_owned(),
        "table small.linkage --set c=3.5 --steps 6 --rate 2".to_owned(),
        format!("draw small.linkage {at} -o small.svg"),
        format!("sheet small.linkage {at} --rate 1 -o small.txt"),
        format!("certify small.linkage {at}"),
        format!("report small.linkage {at} -o small.html"),
        format!("equilibrium small.linkage {at}"),
        format!("simulate small.linkage {at} --to 0.1 --steps 3"),
    ] {
        let file = command.split_whitespace().last().filter(|_| command.contains("-o ")).unwrap_or("-");
        let read = |file: &str| if file == "-" { String::new() } else { folder.read(file) };
        let one = folder.run(&command);
        let of_one = read(file);
        let other = folder.run(&capital(&command).replace("small", "large"));
        let of_other = read(&file.replace("small", "large"));
        assert_eq!(one.code, Some(0), "{command}: {one:?}");
        let small = |text: &str| {
            let text = text.replace("large", "small").to_lowercase();
            text.split_whitespace().collect::<Vec<_>>().join(" ")
        };
        assert_eq!(small(&other.messages), small(&one.messages), "{command}");
        assert_eq!(small(&other.output), small(&one.output), "{command}");
        // Names in a picture have other widths.
        let of_file = |text: &str| match file.ends_with(".txt") {
            true => small(text),
            false => {
                ["<path", "%3cpath", "<figure"].map(|part| small(text).matches(part).count().to_string()).join(", ")
            }
        };
        assert_eq!(of_file(&of_other), of_file(&of_one), "{command}");
    }
}

/// Capitals in parameters, inputs and unknowns, and names of several words.
#[test]
fn pictures_have_names_as_they_are_written() {
    let folder = Folder::new();
    for (place, text) in [
        "mechanism S { param L = 1; input th; point B = L@th; }",
        "mechanism S { param CrankLength = 2; input InputAngle; point Pin = CrankLength@InputAngle; }",
        "mechanism S { param Leg = 2; input Turn; unknown X, Y; loop Leg@Turn = (X, Y); point End = (X, Y); }",
    ]
    .iter()
    .enumerate()
    {
        folder.write("s.linkage", text);
        let picture = folder.run("draw s.linkage -o s.svg");
        assert_eq!((picture.code, picture.messages.as_str()), (Some(0), "wrote s.svg\n"), "{place}: {picture:?}");
        assert_eq!(folder.run("animate s.linkage --steps 8 -o s.svg").messages, "wrote s.svg\n", "{place}");
        let sheet = folder.run("sheet s.linkage --rate 1 -o s.html");
        assert_eq!(sheet.messages, "wrote s.html\n", "{place}");
        assert!(folder.read("s.html").contains("<figcaption>"), "{place}");
        assert!(!folder.run("table s.linkage --steps 4 --rate 1").output.contains(",,"), "{place}");
    }
}

/// A picture that is left out is said.
#[test]
fn pictures_that_are_left_out() {
    let folder = Folder::new();
    let text = "mechanism Far { param a = 1.2e308; input th; unknown x, y; loop a@th = (x, y); point B = a@th; \
                point C = a@(th + 180deg); }";
    folder.write("far.linkage", text);
    let why = "the extent of the drawing must be finite, and positive if it is a scale, a radius or a duration\n";
    folder.run("draw far.linkage -o far.svg").fails(1, &format!("error: {why}"));
    folder
        .run("sheet far.linkage --at th=0 -o far.html")
        .works(&format!("the sheet has no picture: {why}wrote far.html\n"));
    folder.run("sheet far.linkage --at th=0 -o far.txt").works("wrote far.txt\n");
    folder
        .run("report far.linkage --at th=0 -o far.html")
        .works(&format!("mode 1 has no picture: {why}wrote far.html\n"));
    assert!(folder.read("far.html").contains("<figcaption>Mode 1 has no picture</figcaption>"));
}
