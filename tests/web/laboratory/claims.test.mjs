// The claims ledger: chapters, filter, search, figures beside claims, and the filter in the address.
import assert from "node:assert/strict";
import test from "node:test";

import {filterOf, queryOf} from "../../../web/laboratory/claims/address.js";
import {figureNumbers, numberOf, placeFigures, titleOf} from "../../../web/laboratory/claims/figures.js";
import {allChapters, chaptersOf, claimsForCounts, filtered, noFilter, readLedger} from "../../../web/laboratory/claims/ledger.js";
import {partsOf} from "../../../web/laboratory/claims/parts.js";
import {folded, highlighted, matches, termsOf} from "../../../web/laboratory/claims/search.js";
import {countVerdicts, verdictOf, verdicts} from "../../../web/laboratory/claims/verdicts.js";

const claim = (id, verdict, place, statement = "", more = {}) =>
  ({id, verdict, place, statement, printed: "", measured: "", why: "", runs: 1, least_runs: 1, ...more});

const ledger = () => readLedger([
  {id: "3.1", title: "A monobot", figures: [], claims: [
    claim("3.1-one", "holds", "(3.8), Example 3.1", "an eigenvalue is 1"),
    claim("3.1-two", "does-not-hold", "Section 2.2 and Example 3.1", "the variance falls", {why: "it rises"})]},
  {id: "mrclam", title: "Five robots", figures: [],
    claims: [claim("mrclam-one", "undecided", "Section 5.2.1, (5.16)-(5.19)", "robots localize", {measured: "σ 0.2 m"})]},
  {id: "3.2", title: "Car park", skipped: "the recording is not there", figures: [], claims: []},
]);
const idsOf = (entries) => entries.flatMap((entry) => entry.claims.map(({id}) => id));

test("chapters are those that the place names", () => {
  assert.deepEqual(chaptersOf("(3.8), Example 3.1", "3.1"), [3]);
  assert.deepEqual(chaptersOf("Sections 2.2 and 3.1, property (3)", "text-1-3"), [2, 3]);
  assert.deepEqual(chaptersOf("Section 2.2.3 and head of Chapter 3", "text-1-3"), [2, 3]);
  assert.deepEqual(chaptersOf("below (4.2), of [55]", "text-4"), [4]);
  assert.deepEqual(chaptersOf("Section 5.2.1, (5.16)-(5.19)", "mrclam"), [5]);
  assert.deepEqual(chaptersOf("Section 1.3, third contribution, with [6]", "consistency"), [1]);
  assert.deepEqual(chaptersOf("Huang, Mourikis, Roumeliotis (ISER 2008)", "consistency"), []);
});

test("a place without a number is in the chapter of its example", () => {
  assert.deepEqual(chaptersOf("the abstract", "6.4.3"), [6]);
  assert.deepEqual(chaptersOf("the abstract", "text-4"), [4]);
});

test("filters by verdict, by chapter, by text, and by all at once", () => {
  const by = (part) => idsOf(filtered(ledger(), {...noFilter, ...part}));
  assert.deepEqual(by({verdicts: ["holds"]}), ["3.1-one"]);
  assert.deepEqual(by({verdicts: ["holds", "undecided"]}), ["3.1-one", "mrclam-one"]);
  assert.deepEqual(by({chapters: [2]}), ["3.1-two"]);
  assert.deepEqual(by({chapters: [2, 5]}), ["3.1-two", "mrclam-one"]);
  assert.deepEqual(by({search: "RISES"}), ["3.1-two"]);
  assert.deepEqual(by({search: "monobot"}), ["3.1-one", "3.1-two"]);
  assert.deepEqual(by({verdicts: ["holds"], chapters: [2]}), []);
  assert.deepEqual(by({verdicts: ["does-not-hold"], chapters: [3], search: "variance"}), ["3.1-two"]);
});

test("without a filter every example stays, with one only those with claims", () => {
  assert.deepEqual(filtered(ledger(), noFilter).map(({id}) => id), ["3.1", "mrclam", "3.2"]);
  assert.deepEqual(filtered(ledger(), {...noFilter, search: "robots"}).map(({id}) => id), ["mrclam"]);
});

test("the counts of verdicts ignore the choice of verdicts, and nothing else", () => {
  const claims = claimsForCounts(ledger(), {verdicts: ["undecided"], chapters: [3], search: ""});
  assert.deepEqual(countVerdicts(claims).map(({count}) => count), [1, 0, 1, 0]);
  assert.deepEqual(allChapters(ledger()), [2, 3, 5]);
});

test("each verdict has words of its own, an unknown one keeps its own", () => {
  assert.equal(new Set(verdicts.map(({words}) => words)).size, 4);
  assert.equal(verdictOf("does-not-hold").words, "does not hold");
  assert.equal(verdictOf("doubtful").words, "doubtful");
});

test("a document of another kind is refused", () => {
  assert.throws(() => readLedger({scenario: "room"}), /not a list/);
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

test("the address carries the filter there and back, and keeps the token", () => {
  const filter = {verdicts: ["holds", "undecided"], chapters: [3, 5], search: 'mean "of all" & σ'};
  const query = queryOf(filter, "?token=abc");
  assert.match(query, /^\?token=abc&verdict=holds,undecided&chapter=3,5&/);
  assert.deepEqual(filterOf(query), filter);
  assert.equal(queryOf(noFilter, query), "?token=abc");
  assert.equal(queryOf(noFilter), "");
  assert.deepEqual(filterOf("?chapter=x,3"), {verdicts: [], chapters: [3], search: ""});
});
