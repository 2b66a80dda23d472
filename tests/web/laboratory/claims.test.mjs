// The claims ledger: chapters, filter, search, counts, errata, numbers, citations, figures beside claims, and the filter in
// the address.
import assert from "node:assert/strict";
import {readFileSync} from "node:fs";
import test from "node:test";

import {filterOf, queryOf, queryOfView, viewOf} from "../../../web/laboratory/claims/address.js";
import {citationOf} from "../../../web/laboratory/claims/citation.js";
import {countRows} from "../../../web/laboratory/claims/counts.js";
import {errataOf} from "../../../web/laboratory/claims/errata_view.js";
import {figureNumbers, numberOf, placeFigures, titleOf} from "../../../web/laboratory/claims/figures.js";
import {countFindings, findingOf, findings} from "../../../web/laboratory/claims/findings.js";
import {headlinesOf} from "../../../web/laboratory/claims/front_view.js";
import {allChapters, allClaims, chaptersOf, claimsForCounts, filtered, isEmpty, noFilter, readLedger} from "../../../web/laboratory/claims/ledger.js";
import {boundOf, intervalText, numberText, scaleOf, valueText} from "../../../web/laboratory/claims/number.js";
import {foldedParts, partsOf} from "../../../web/laboratory/claims/parts.js";
import {remarks, rules} from "../../../web/laboratory/claims/rules.js";
import {folded, highlighted, matches, termsOf} from "../../../web/laboratory/claims/search.js";
import {byChapter, chapterName, chapterOf, placeAndSource, sectionName, sourceOf} from "../../../web/laboratory/claims/source.js";

const claim = (id, finding, place, statement = "", more = {}) =>
  ({id, origin: "own", finding, place, statement, printed: "", measured: "", rule: "identity", why: "", runs: 1, least_runs: 1, ...more});
const ofThesis = (section, quotation = "q") => ({origin: "thesis", section, pages: "42-50", quotation});

const ledger = () => readLedger([
  {id: "3.1", title: "A monobot", figures: [], claims: [
    claim("3.1-one", "holds", "(3.8), Example 3.1", "an eigenvalue is 1", ofThesis("3.1")),
    claim("3.1-two", "does-not-hold", "Section 2.2 and Example 3.1", "the variance falls", {why: "it rises", ...ofThesis("2.2")})]},
  {id: "mrclam", title: "Five robots", figures: [],
    claims: [claim("mrclam-one", "undecided", "Section 5.2.1, (5.16)-(5.19)", "robots localize", {measured: "σ 0.2 m", rule: "coverage"})]},
  {id: "3.2", title: "Car park", skipped: "the recording is not there", figures: [], claims: []},
]);
const idsOf = (entries) => entries.flatMap((entry) => entry.claims.map(({id}) => id));

test("chapters are those that the place names", () => {
  assert.deepEqual(chaptersOf("(3.8), Example 3.1", "3.1"), ["3"]);
  assert.deepEqual(chaptersOf("Sections 2.2 and 3.1, property (3)", "text-1-3"), ["2", "3"]);
  assert.deepEqual(chaptersOf("Section 2.2.3 and head of Chapter 3", "text-1-3"), ["2", "3"]);
  assert.deepEqual(chaptersOf("below (4.2), of [55]", "text-4"), ["4"]);
  assert.deepEqual(chaptersOf("Section 5.2.1, (5.16)-(5.19)", "mrclam"), ["5"]);
  assert.deepEqual(chaptersOf("Section 1.3, third contribution, with [6]", "consistency"), ["1"]);
  assert.deepEqual(chaptersOf("Appendix C.4", "6.3"), ["C"]);
  assert.deepEqual(chaptersOf("Huang, Mourikis, Roumeliotis (ISER 2008)", "consistency"), []);
});

test("a place without a number is in the chapter of its example", () => {
  assert.deepEqual(chaptersOf("the abstract", "6.4.3"), ["6"]);
  assert.deepEqual(chaptersOf("the abstract", "text-4"), ["4"]);
});

test("a claim of the thesis is in the chapter of its quotation alone", () => {
  const [entry] = readLedger([{id: "3.1", title: "", figures: [], claims: [
    claim("a", "holds", "(3.8) and Section 2.2", "", ofThesis("2.2")), claim("b", "holds", "(3.8)", "", ofThesis("Abstract"))]}]);
  assert.deepEqual(entry.claims.map(({chapters}) => chapters), [["2"], ["Abstract"]]);
});

test("sections and pages as they are cited", () => {
  assert.deepEqual(["3.1", "3", "C.2", "B", "Abstract"].map(sectionName),
    ["Section 3.1", "Chapter 3", "Appendix C.2", "Appendix B", "Abstract"]);
  assert.deepEqual(["3.1", "C.2", "Abstract"].map(chapterOf), ["3", "C", "Abstract"]);
  assert.deepEqual(["3", "C", "Abstract"].map(chapterName), ["Chapter 3", "Appendix C", "Abstract"]);
  assert.deepEqual(["C", "10", "2", "Abstract", "A"].sort(byChapter), ["Abstract", "2", "10", "A", "C"]);
  assert.equal(sourceOf({section: "3.1", pages: "42-51"}), "Section 3.1, pp. 42–51");
  assert.equal(sourceOf({section: "6.1", pages: "138"}), "Section 6.1, p. 138");
  assert.equal(sourceOf({place: "(3.8)"}), "");
  assert.deepEqual(placeAndSource({place: "(3.8)", section: "3.1", pages: ""}), ["(3.8)", "Section 3.1"]);
  assert.deepEqual(placeAndSource({place: "Section 3.1", section: "3.1", pages: ""}), ["", "Section 3.1"]);
});

test("filters by finding, chapter, rule, origin, text, and by all at once", () => {
  const by = (part) => idsOf(filtered(ledger(), {...noFilter, ...part}));
  assert.deepEqual(by({findings: ["holds"]}), ["3.1-one"]);
  assert.deepEqual(by({findings: ["holds", "undecided"]}), ["3.1-one", "mrclam-one"]);
  assert.deepEqual(by({chapters: ["2"]}), ["3.1-two"]);
  assert.deepEqual(by({chapters: ["2", "5"]}), ["3.1-two", "mrclam-one"]);
  assert.deepEqual(by({rule: "coverage"}), ["mrclam-one"]);
  assert.deepEqual(by({origin: "thesis"}), ["3.1-one", "3.1-two"]);
  assert.deepEqual(by({origin: "own"}), ["mrclam-one"]);
  assert.deepEqual(by({search: "RISES"}), ["3.1-two"]);
  assert.deepEqual(by({search: "monobot"}), ["3.1-one", "3.1-two"]);
  assert.deepEqual(by({findings: ["holds"], chapters: ["2"]}), []);
  assert.deepEqual(by({findings: ["does-not-hold"], chapters: ["2"], origin: "thesis", rule: "identity", search: "variance"}), ["3.1-two"]);
});

test("without a filter every example stays, with one only those with claims", () => {
  assert.deepEqual(filtered(ledger(), noFilter).map(({id}) => id), ["3.1", "mrclam", "3.2"]);
  assert.deepEqual(filtered(ledger(), {...noFilter, search: "robots"}).map(({id}) => id), ["mrclam"]);
});

test("the counts of findings ignore the choice of findings, and nothing else", () => {
  const claims = claimsForCounts(ledger(), {...noFilter, findings: ["undecided"], chapters: ["3"]});
  assert.deepEqual(countFindings(claims).map(({count}) => count), [1, 0, 0, 0, 0]);
  assert.deepEqual(allChapters(ledger()), ["2", "3", "5"]);
});

test("each finding has words, a reason and a meaning of its own; an unknown one keeps its own word", () => {
  for (const part of ["words", "reason", "meaning"]) assert.equal(new Set(findings.map((finding) => finding[part])).size, 5);
  assert.equal(findingOf("holds-if").words, "holds if");
  assert.equal(findingOf("doubtful").words, "doubtful");
});

test("the table of counts: the thesis by chapter, ours apart, and each cell shows what it counts", () => {
  const entries = ledger();
  const rows = countRows(entries);
  assert.deepEqual(rows.map(({label, cells}) => [label, ...cells.map(({count}) => count)]), [
    ["Chapter 2", 0, 0, 0, 1, 0, 1], ["Chapter 3", 1, 0, 0, 0, 0, 1], ["The thesis", 1, 0, 0, 1, 0, 2], ["Ours", 0, 0, 0, 0, 1, 1]]);
  for (const {cells} of rows)
    for (const {count, filter} of cells) assert.equal(allClaims(filtered(entries, filter)).length, count);
});

test("headlines: ten at most, each with the figure that its claim names", () => {
  const claims = Array.from({length: 12}, (_, i) => claim(`c${i}`, "holds", i === 1 ? "Figure 3.4" : "(3.8)", "", i === 3 ? {} : {headline: `h${i}`}));
  const found = headlinesOf(readLedger([{id: "3.1", title: "", claims, figures: [{id: "fig-3.4", file: "f.svg", data: ""}]}]));
  assert.deepEqual(found.map(({claim: {id}}) => id), ["c0", "c1", "c2", "c4", "c5", "c6", "c7", "c8", "c9", "c10"]);
  assert.deepEqual(found.map(({figure}) => figure?.file), [undefined, "f.svg", ...Array(8).fill(undefined)]);
});

test("errata are the misprints of the thesis", () => {
  const entries = readLedger([{id: "3.1", title: "", figures: [], claims: [
    claim("a", "misprint", "(3.8)", "", ofThesis("3.1")), claim("b", "misprint", "(3.8)"), claim("c", "holds-if", "(3.8)", "", ofThesis("3.1"))]}]);
  assert.deepEqual(errataOf(entries).map(({id}) => id), ["a"]);
});

const source = (name) => readFileSync(new URL(`../../../incognita/report/${name}`, import.meta.url), "utf8");
/** The C++ string literals of a text, joined. */
const literal = (text) => [...text.matchAll(/"((?:[^"\\]|\\.)*)"/g)].map(([, part]) => JSON.parse(`"${part}"`)).join("");

test("rules have the names and texts that the program decides by", () => {
  const text = source("ledger.cpp");
  const returned = (name) => Array.from(text.split(`* ${name}(Rule rule) {`)[1].split("\n}")[0]
    .matchAll(/case Rule::(\w+):\s*return ((?:"(?:[^"\\]|\\.)*"\s*)+);/g), ([, rule, literals]) => [rule, literal(literals)]);
  assert.deepEqual(rules.map(({id}) => id), returned("name").map(([, name]) => name));
  assert.deepEqual(rules.map(({text: words}) => words), returned("rule_text").map(([, words]) => words));
});

test("findings and remarks are explained as on the page docs/claims.md", () => {
  const text = literal(source("ledger_markdown.cpp").split("std::string rules() {")[1].split("| rule |")[0] + '"');
  for (const {words, meaning} of findings) assert.ok(text.includes(`- **${words}**: ${meaning}\n`), words);
  assert.ok(text.replaceAll("\n", " ").includes(remarks));
});

const interval = (value, low, high, unit = "", what = "x") => ({what, value, low, high, unit});

test("numbers have as many digits as their interval is wide", () => {
  const texts = (...parts) => [valueText(interval(...parts)), intervalText(interval(...parts))];
  assert.deepEqual(texts(0.15812, 0.1432, 0.1764, "m"), ["0.158 m", "0.143 to 0.176"]);
  assert.deepEqual(texts(1813.2, 1750.6, 1881, "m"), ["1813 m", "1751 to 1881"]);
  assert.deepEqual(texts(0.99841, 0.99812, 0.99873), ["0.99841", "0.99812 to 0.99873"]);
  assert.deepEqual(texts(-0.004, -0.25, 0.31, "nats"), ["−0.004 nats", "−0.250 to 0.310"]);
  assert.deepEqual(texts(-0.0001, -0.25, 0.31), ["0.000", "−0.250 to 0.310"]);
  assert.deepEqual(texts(0.932, 0.858, 1.01), ["0.932", "0.858 to 1.010"]);
  assert.deepEqual(texts(-2.31e-10, -2.5e-10, -2e-10), ["−2.31 × 10⁻¹⁰", "−2.5 × 10⁻¹⁰ to −2 × 10⁻¹⁰"]);
  assert.deepEqual(texts(5, undefined, 7), ["5", "up to 7, no lower end known"]);
  assert.deepEqual(texts(5, 3, undefined), ["5", "from 3, no upper end known"]);
  assert.deepEqual(texts(undefined, undefined, undefined), ["unknown", "not known"]);
});

test("a number without chance has no interval, in words or drawn", () => {
  const exact = (x) => interval(x, x, x, "%", "growth");
  assert.deepEqual([3, 0, 12345, 0.123456, 2.3e7].map((x) => valueText(exact(x))), ["3 %", "0 %", "12345 %", "0.1235 %", "2.3 × 10⁷ %"]);
  assert.equal(numberText(exact(3)), "growth: 3 %");
  assert.equal(scaleOf(exact(3)), undefined);
});

test("the scale of the drawn interval keeps the order, begins at zero, and shows an end only where there is one", () => {
  const scale = scaleOf(interval(0.158, 0.143, 0.176));
  assert.ok(0 < scale.zero && scale.zero < scale.low && scale.low < scale.value && scale.value < scale.high && scale.high < 1);
  assert.ok(Math.abs((scale.value - scale.zero) / (scale.high - scale.zero) - 0.158 / 0.176) < 1e-12);
  const open = scaleOf(interval(-70, -95, undefined));
  assert.equal(open.high, undefined);
  assert.ok(open.low < open.value && open.value < open.zero);
  const near = scaleOf(interval(0.91, 0.88, 0.93), 0.9);
  assert.ok(near.low < near.bound && near.bound < near.value && near.zero === undefined);
  assert.equal(scaleOf(interval(1, undefined, undefined)), undefined);
});

test("a bound is drawn only where the rule itself names it", () => {
  const bound = (rule, ...parts) => boundOf(claim("a", "holds", "", "", {rule, number: interval(...parts)}));
  assert.equal(bound("coverage", 0.91, 0.88, 0.93, "", "share inside 2 sigma"), 0.9);
  assert.equal(bound("coverage", 91, 88, 93, "%", "share inside 2 sigma"), 90);
  assert.equal(bound("coverage", 0.01, -0.02, 0.03, "", "share inside on flat ground less on waves"), undefined);
  assert.equal(bound("coverage", 1.3, 1.1, 1.5, "", "mean NEES"), undefined);
  assert.equal(bound("boundedness", 2, 1, 3, "%", "growth of the sigma"), 5);
  assert.equal(bound("boundedness", 1.02, 1, 1.1, "", "sigma at the end"), undefined);
  assert.equal(bound("superiority", 2, 1, 3, "%", "share"), undefined);
  assert.equal(boundOf(claim("a", "holds", "", "", {rule: "coverage"})), undefined);
});

test("a citation has id, quotation, section and pages, findings, number and address, and no token", () => {
  const cited = claim("4.1-a b", "does-not-hold", "(4.2)", "s", {...ofThesis("4.1", "observable"), by_method: "holds",
    number: interval(0.158, 0.143, 0.176, "m", "rms error"), runs: 20});
  assert.equal(citationOf(cited, "https://x.org/ledger/"),
    "[4.1-a b] “observable” (T. A. Vidal Calleja, Visual Navigation in Unknown Environments, 2007, Section 4.1, pp. 42–50). " +
    "Finding: does not hold; by the thesis’ method: holds. Rms error: 0.158 m (95 % interval 0.143 to 0.176); 20 runs. " +
    "incognita, claims ledger, https://x.org/ledger/#4.1-a%20b");
  assert.match(citationOf(claim("b", "holds", "(4.2)", "it falls"), ""),
    /^\[b\] it falls \(a claim of incognita, beside \(4\.2\) of .*\)\. Finding: holds\. 1 run\. incognita, claims ledger$/);
});

test("a document of another kind is refused", () => {
  assert.throws(() => readLedger({scenario: "room"}), /not a list/);
  const old = {id: "3.1", title: "", claims: [{id: "3.1-one", verdict: "holds", place: "", statement: ""}], figures: []};
  assert.throws(() => readLedger([old]), /earlier program: 3\.1-one/);
});

test("all words must occur, quoted ones together", () => {
  assert.deepEqual(termsOf(' Two  "mean  NEES" two "open end'), ["two", "mean nees", "open end"]);
  assert.deepEqual(termsOf('  "" '), []);
  const text = folded("The mean NEES of the Kálmán filter");
  assert.ok(matches(text, termsOf("filter mean")));
  assert.ok(matches(text, termsOf("kalman")));
  assert.ok(!matches(text, termsOf('"NEES mean"')));
  assert.ok(!matches(text, termsOf("mean median")));
});

test("folding keeps positions, so that what is marked is what was found", () => {
  for (const text of ["Kálmán σ² 15° İstanbul ß 𝛔", "ﬁlter"]) assert.equal(folded(text).length, text.length);
  assert.deepEqual(highlighted("Kálmán filter", ["kal"]),
    [{text: "Kál", found: true}, {text: "mán filter", found: false}]);
});

test("overlapping and adjacent occurrences are marked once, and no letter is lost", () => {
  assert.deepEqual(highlighted("aaab", ["aa", "ab"]), [{text: "aaab", found: true}]);
  assert.deepEqual(highlighted("x map y", ["map", "ma"]).map(({text}) => text), ["x ", "map", " y"]);
  assert.deepEqual(highlighted("abc", []), [{text: "abc", found: false}]);
  assert.deepEqual(highlighted("", ["a"]), []);
});

test("figures of a place", () => {
  assert.deepEqual(figureNumbers("Example 3.5, Figures 3.10 (c), 3.11"), ["3.10", "3.11"]);
  assert.deepEqual(figureNumbers("below (3.11), Figure 3.4 (b), (c)"), ["3.4"]);
  assert.deepEqual(figureNumbers("Figure 4.4, Example 4.6"), ["4.4"]);
  assert.deepEqual(figureNumbers("Figure 5.5 and Figure 5.8, captions; below (5.12)"), ["5.5", "5.8"]);
  assert.deepEqual(figureNumbers("Figures 5.5 and 5.8"), ["5.5", "5.8"]);
  assert.deepEqual(figureNumbers("(3.8), Example 3.1"), []);
  assert.equal(numberOf({id: "fig-3.11-ekf"}), "3.11");
  assert.equal(numberOf({id: "fig-riccati"}), "");
  assert.equal(titleOf({id: "fig-3.11-first-estimate"}), "Figure 3.11, first estimate");
  assert.equal(titleOf({id: "fig-3.1"}), "Figure 3.1");
});

test("each figure is beside one claim that names it, spread over them, the others at the end", () => {
  const figures = ["fig-3.1", "fig-3.11", "fig-3.11-ekf", "fig-map"].map((id) => ({id}));
  const claims = ["Figures 3.11", "Figure 3.1 (a)", "Figure 3.11 (b), Example 3.5", "Section 3.5"]
    .map((place, i) => claim(`c${i}`, "holds", place));
  const {ofClaims, rest} = placeFigures(claims, figures);
  assert.deepEqual(ofClaims.map(({shown}) => shown.map(({id}) => id)), [["fig-3.11"], ["fig-3.1"], ["fig-3.11-ekf"], []]);
  assert.deepEqual(ofClaims.map(({mentioned}) => mentioned.map(({id}) => id)), [["fig-3.11-ekf"], [], ["fig-3.11"], []]);
  assert.deepEqual(rest.map(({id}) => id), ["fig-map"]);
});

test("results break at semicolons outside parentheses", () => {
  assert.deepEqual(partsOf("a (b; c); d; e"), ["a (b; c)", "d", "e"]);
  assert.deepEqual(partsOf("[0.5 2;0 0.5]"), ["[0.5 2;0 0.5]"]);
  assert.deepEqual(partsOf("a); b"), ["a)", "b"]);
});

test("long results are folded after some letters, and nothing is lost", () => {
  assert.deepEqual(foldedParts("a; b; c", 10), {shown: ["a", "b", "c"], folded: []});
  assert.deepEqual(foldedParts("aaaa; bbbb; cccc; dddd", 8), {shown: ["aaaa", "bbbb"], folded: ["cccc", "dddd"]});
  assert.deepEqual(foldedParts("aaaaaaaaaaaaaaaaaaaaa; b", 8), {shown: ["aaaaaaaaaaaaaaaaaaaaa"], folded: ["b"]});
  assert.deepEqual(foldedParts("It rises by 0.2 m. Then it falls. At last", 12),
    {shown: ["It rises by 0.2 m."], folded: ["Then it falls.", "At last"]});
  assert.deepEqual(foldedParts("x".repeat(99), 12), {shown: ["x".repeat(99)], folded: []});
});

test("the address carries the filter there and back, and keeps the token and the view", () => {
  const filter = {findings: ["holds", "holds-if"], chapters: ["3", "Abstract"], rule: "equality", origin: "thesis", search: 'mean "of all" & σ'};
  const query = queryOf(filter, "?token=abc&view=errata");
  assert.match(query, /^\?token=abc&view=errata&finding=holds,holds-if&chapter=3,Abstract&rule=equality&origin=thesis&/);
  assert.deepEqual(filterOf(query), filter);
  assert.equal(queryOf(noFilter, query), "?token=abc&view=errata");
  assert.equal(queryOf(noFilter), "");
  assert.ok(isEmpty(filterOf("")) && !isEmpty(filter) && isEmpty({...noFilter, search: ' "" '}));
});

test("addresses of earlier pages still work", () => {
  const filter = filterOf("?verdict=does-not-hold,holds-as-corrected&chapter=3");
  assert.deepEqual(filter, {...noFilter, findings: ["does-not-hold", "misprint", "holds-if"], chapters: ["3"]});
  assert.equal(queryOf(filter, "?verdict=x"), "?finding=does-not-hold,misprint,holds-if&chapter=3");
});

test("the view is in the address, the claims without a word", () => {
  assert.equal(viewOf("?view=errata"), "errata");
  assert.equal(viewOf("?view=other"), "claims");
  assert.equal(queryOfView("rules", "?token=abc"), "?token=abc&view=rules");
  assert.equal(queryOfView("claims", "?view=rules&chapter=3"), "?chapter=3");
});
