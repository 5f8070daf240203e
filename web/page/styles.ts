// The styles of drawings, charts and sheets, which are those of the program. A sheet on its own page asks the window for its
// width; here it asks the tab.

import chart from "../../linkage-report/src/chart/style.css";
import charted from "../../linkage-report/src/chart/page.css";
import linkage from "../../linkage-report/src/drawing/linkage.css";
import plot from "../../linkage-report/src/drawing/plot.css";
import page from "../../linkage-report/src/sheet/style.css";

const inShadow = page
    .replace(/:root\b/gu, ":host")
    .replace(/(^|[\s}])html\{[^}]*\}/gu, "$1")
    .replace(/(^|[\s}])body\{/gu, "$1.body{")
    .replace(/(^|[\s}])main\{/gu, "$1.body{")
    .replace(/@media \(max-width/gu, "@container (max-width")
    .replace(/:target/gu, ".target");

const fit =
    ":host{container-type:inline-size;background:none}.body{background:none;padding:2.5rem 1.5rem 5rem;overflow-wrap:break-word}.body>section:first-child{margin-top:0}";

export const sheetStyles = [inShadow, chart, charted.replace(/(^|[\s}])main:has/gu, "$1.body:has"), fit];
/** Drawings bring their own style: these rules are more specific. */
export const pictureStyles = [
    linkage,
    plot,
    ".body{height:100%}svg{display:block;width:100%;height:100%}.body .linkage .paper{fill:none}.body .linkage .title{display:none}",
];
const bare = "svg{display:block;width:100%;height:100%}.body .linkage :is(.paper,.frame){fill:none;stroke:none}.body .linkage :is(text,.grid){display:none}";
export const smallStyles = [linkage, plot, `.body{height:100%}${bare}`];
export const chartStyles = [chart, ".body{display:block}svg{display:block;width:100%;height:auto}.body .chart{--card:transparent}"];
