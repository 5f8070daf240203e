// Le parole della pagina in italiano.

import type { Words } from "./en";

export const it: Words = {
    code: "it",
    ownName: "Italiano",
    title: "linkage: meccanismi piani dalle equazioni di chiusura",
    slogan: "Meccanismi piani dalle equazioni di chiusura",

    examples: "Esempi",
    file: "File",
    open: "Apri un file…",
    save: "Salva in un file",
    share: "Copia il collegamento",
    copy: "Copia",
    copyMacro: "Rust: la macro con questo testo",
    copyRust: "Rust: il codice scritto dalla macro",
    copyLatex: "LaTeX: il foglio",
    copySvg: "SVG: la figura",
    copyCsv: "CSV: il moto",
    language: "Lingua",
    theme: "Colori",
    themes: { auto: "Come il sistema", light: "Chiari", dark: "Scuri" },
    licences: "Licenze",
    close: "Chiudi",
    skip: "Vai alla figura",

    textLabel: "Il meccanismo, come testo",
    text: "Testo",
    mistakes: (count) => (count === 1 ? "1 errore" : `${count} errori`),
    noMistakes: "Nessun errore",
    compiling: "Lettura del testo…",
    place: (line, column) => `riga ${line}, colonna ${column}`,
    empty: "Un testo vuoto non ha meccanismi: si può cominciare da un esempio.",
    tooLong: (kilobytes) => `Questo testo ha ${kilobytes} kB; la pagina accetta testi fino a 1000 kB.`,

    views: "Viste",
    picture: "Figura",
    sheet: "Foglio",
    charts: "Grafici",
    circuits: "Circuiti",
    simulation: "Simulazione",
    report: "Relazione",
    rust: "Rust",
    mechanism: "Meccanismo",

    old: "Questo è di un testo o di una scelta precedente.",
    oldText: "Il testo ha errori: questo è l’ultimo senza.",
    show: "Mostra",
    traces: "Traiettorie",
    velocities: "Velocità",
    accelerations: "Accelerazioni",
    along: "Si muove",
    rate: "a",
    perSecond: "/s",
    pictureLabel: (name) => `${name} in questa posizione. Le coppie si possono trascinare; i cursori fanno lo stesso.`,
    dragHint: "Si trascini una coppia: il movente segue il puntatore.",
    positions: "Posizioni",
    morePositions: "Le posizioni sono molte: altre sono tralasciate.",
    positionsHint: "Tutte le posizioni con questi moventi",
    position: (branch) => `Posizione ${branch}`,
    onlyPosition: "unica",
    noPositions: "Con questi moventi non c’è posizione.",

    sliders: "Cursori e numeri",
    inputs: "Moventi",
    parameters: "Parametri",
    numbers: "Numeri",
    value: (name) => `${name}, valore`,
    notNumber: "Si scriva un numero, come 12.5 o 45°.",
    reset: "Come nel testo",
    intoText: "Nel testo",
    turn: (count) => `giro ${count}`,
    name: "Nome",
    valueHead: "Valore",
    rateHead: "Velocità",
    accelerationHead: "Accelerazione",
    ends: "Limiti",
    hide: "Nascondi",
    limit: (limit) => {
        switch (limit.is) {
            case "dead_point":
                return `punto morto di ${limit.group}`;
            case "change_point":
                return `punto di biforcazione di ${limit.group}, dove si incrociano moti`;
            case "no_direction":
                return "punto morto o di biforcazione";
            case "least":
                return `valore minimo di ${limit.of}`;
            case "largest":
                return `valore massimo di ${limit.of}`;
            case "too_near":
                return "altre posizioni sono troppo vicine per sapere quale prosegue";
            case "no_position":
                return "qui le maglie non si chiudono";
            case "too_long":
                return `più di ${limit.steps} passi`;
            case "error":
                return limit.why;
        }
    },
    inputStops: (input, value, limit) => `${input} si ferma a ${value}: ${limit}.`,
    parametersStop: (limit) => `I parametri non vanno oltre: ${limit}.`,

    choose: "Colonne",
    chooseHint: "Si scelgano le colonne: ogni specie di grandezza ha un grafico.",
    overMotion: (name) => `Lungo il moto di ${name}`,

    circuitsHead: (positions, motions, circuits) => {
        const count = (count: number, one: string, more: string): string => `${count} ${count === 1 ? one : more}`;
        return `${count(positions, "posizione", "posizioni")}, ${count(motions, "moto", "moti")}, ${count(circuits, "circuito", "circuiti")}`;
    },
    motionOfCircuit: (motion, circuit) => `moto ${motion}, circuito ${circuit}`,
    way: ({ way, turns }, input, least, largest) => {
        switch (way) {
            case "turns":
                return `${input} fa giri interi${turns === 1 ? "" : `; il moto si chiude dopo ${turns} giri`}`;
            case "to_and_fro":
                return `${input} va e viene tra ${least} e ${largest}`;
            case "ends":
                return `${input} da ${least} a ${largest}, gli estremi di intervalli`;
            case "open":
                return `${input} da ${least} a ${largest} e oltre: il moto non si chiude`;
        }
    },

    scene: "Scena",
    until: "fino a",
    seconds: "s",
    startRates: "Velocità iniziali",
    tolerance: "Tolleranza relativa",
    run: "Simula",
    play: "Avvia",
    pause: "Pausa",
    time: "Tempo",
    speed: "Rapidità",
    noScenes: "Questo meccanismo non ha scene: una scena nomina corpi e forze, come negli esempi Chiudiporta e Motore.",
    notSimulated: "Questa scena non ha un moto da calcolare.",
    sceneParameters: "Parametri della scena",
    fromHere: "Da questa posizione",

    stop: "Ferma",
    stopped: "Fermato.",
    replaced: "Una domanda più recente ha preso il suo posto.",
    again: "Calcola di nuovo",
    working: { compile: "Lettura del testo", move: "Spostamento", draw: "Disegno", motion: "Il moto viene seguito", positions: "Ricerca delle posizioni", chart: "Disegno dei grafici", tab: "Calcolo", copy: "Calcolo" },
    loading: "Caricamento…",

    noWebAssembly: "Questo browser non ha WebAssembly, con cui la pagina calcola: un browser dal 2023 in poi lo ha.",
    followed: (file: string): string => `Questa pagina segue ${file}.`,
    serverGone: "Il programma che serve questa pagina è terminato: il file non è più seguito.",
    jumped: "Nessun moto porta qui dalla posizione di prima: questa è la posizione più vicina con i valori del testo.",
    liveFailed: "I cursori di questa scheda non si caricano: il file può essere incompleto. I numeri sono quelli della posizione con cui è stata scritta.",
    liveFold: "Cursori e figura",
    moduleFailed: "La parte della pagina che calcola non si carica: il file può essere incompleto.",
    trap: "Il calcolo è fallito su questo testo ed è stato riavviato; il testo è rimasto com’era.",
    noLongerCompiles: "Il testo non si compila più.",
    damagedLink: "Il collegamento è danneggiato: il suo testo non si legge.",
    newerLink: "Il collegamento è di una versione più recente di questa pagina.",
    longLink: (kilobytes) => `Un collegamento con questo testo ha ${kilobytes} kB, più degli 8 kB che ogni programma lascia passare: si salvi un file.`,
    linkPlace: "La posizione del collegamento non chiude le maglie: questa è un’altra.",
    notText: "Questo file non è un testo.",
    copied: (item) => `Copiato: ${item}`,
    linkItem: "il collegamento",
    notCopied: "Il browser non lascia copiare alla pagina: si copi da qui.",
    saved: (name) => `Salvato: ${name}`,

    exampleWords: {
        four_bar: ["Quadrilatero articolato", "Manovella, biella e bilanciere: il meccanismo di un foglio universitario sulle equazioni di vincolo."],
        slider_crank: ["Manovellismo di spinta", "Il manovellismo centrato, mosso dal corsoio come motore o dalla manovella come compressore."],
        scotch_yoke: ["Glifo a croce", "Una sola equazione scalare: il meccanismo più piccolo che ci sia."],
        chebyshev: ["Retta di Čebyšëv", "Bilancieri incrociati: il punto medio della biella va quasi diritto."],
        hoecken: ["Retta di Hoecken", "Un quadrilatero che traccia una retta a velocità quasi costante."],
        roberts: ["Retta di Roberts", "Tre triangoli uguali: il vertice di quello di mezzo va quasi diritto."],
        watt_line: ["Retta di Watt", "Due bracci uguali e un’asta fra loro: la guida delle macchine a vapore."],
        peaucellier: ["Cella di Peaucellier", "Un inversore: il primo meccanismo con una retta esatta."],
        pantograph: ["Pantografo", "Due moventi: la penna ripete il cammino della punta, più grande."],
        crank_shaper: ["Limatrice", "Un glifo oscillante muove lo slittone piano all’andata e presto al ritorno."],
        whitworth: ["Ritorno rapido di Whitworth", "Il braccio a glifo fa giri interi e muove uno slittone."],
        rack_steering: ["Sterzo a cremagliera", "Una cremagliera e due tiranti sterzano le ruote anteriori."],
        jansen: ["Gamba di Jansen", "Una gamba della macchina che cammina di Theo Jansen: cinque diadi, dieci angoli incogniti."],
        klann: ["Gamba di Klann", "Una gamba che cammina, con aste piegate, dal suo brevetto."],
        engine: ["Motore", "Un manovellismo spinto dal gas, al freno: quattro tempi, da simulare."],
        compressor: ["Compressore", "Aria compressa, un contrappeso e i carichi su tutti i cuscinetti."],
        door_closer: ["Chiudiporta", "Una porta che si chiude con molla e olio, scatta, rimbalza e si ferma."],
    },
};
