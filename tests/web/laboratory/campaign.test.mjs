// Campaigns: runs.csv, paired differences, units, jitter, ranges of axes.
import assert from "node:assert/strict";
import test from "node:test";

import {linearPart, rangeOf, symlogTicks} from "../../../web/laboratory/campaign/axis.js";
import {parseCsv} from "../../../web/laboratory/campaign/csv.js";
import {jitter} from "../../../web/laboratory/campaign/jitter.js";
import {aboutOf, labelOf, shortNames, unitOf} from "../../../web/laboratory/campaign/measures.js";
import {directionOf, shown, withInterval} from "../../../web/laboratory/campaign/numbers.js";
import {differencesOf, valuesOf} from "../../../web/laboratory/campaign/paired.js";
import {limitOf, readRuns, valueOf} from "../../../web/laboratory/campaign/runs.js";

const runs = () => readRuns([
  "variant,seed,status,reason,ate_m,entropy.total",
  "a,1,done,,0.5,-10", "a,2,done,,0.25,nan", "a,3,failed,\"lost, at the end\",9,-1", "a,4,done,,1,-4",
  "b,1,done,,0.75,-12", "b,2,done,,0.125,-3", "b,3,done,,0.5,-5", "b,4,failed,crashed,0.1,-4", "b,5,done,,1,1",
].join("\n") + "\n");
const seeds = (points) => points.map(({seed}) => seed);

test("CSV: quotes, commas and line breaks in cells", () => {
  assert.deepEqual(parseCsv('a,"b, ""c""\nd",\r\n,e,f\n'), [["a", 'b, "c"\nd', ""], ["", "e", "f"]]);
  assert.deepEqual(parseCsv("a,b"), [["a", "b"]]);
  assert.deepEqual(parseCsv(""), []);
  assert.throws(() => parseCsv('a,"b'), /within quotes/);
});

test("runs.csv that is not one is refused with its line", () => {
  assert.throws(() => readRuns("t,x\n1,2\n"), /does not begin with the columns variant, seed/);
  assert.throws(() => readRuns(""), /does not begin/);
  assert.throws(() => readRuns("variant,seed,status,reason,ate_m\na,1,done,,1\na,2,done\n"), /line 3: 3 cells/);
});

test("unknown values are not there, and 0 is a value", () => {
  const [first, second] = readRuns("variant,seed,status,reason,x,y\na,1,done,,nan,\na,2,done,,0,1e-3\n");
  assert.deepEqual(first.values, {});
  assert.deepEqual(second.values, {x: 0, y: 0.001});
});

test("a failed run has no value, but counts as failed and against a limit", () => {
  const failed = runs().find(({variant, seed}) => variant === "a" && seed === 3);
  assert.equal(failed.reason, "lost, at the end");
  assert.equal(valueOf(failed, "ate_m"), undefined);
  assert.equal(valueOf(failed, "failed"), 1);
  assert.equal(valueOf(failed, "ate_m.above:1"), 0);
  assert.equal(valueOf(runs()[0], "failed"), 0);
  assert.equal(valueOf(runs()[0], "ate_m.below:0.6"), 1);
  assert.equal(valueOf(runs()[0], "ate_m.below:0.5"), 0);
  assert.equal(valueOf(runs()[0], "ate_m.above:-1e-2"), 1);
  assert.equal(valueOf(runs()[0], "absent.below:1"), 0);
  assert.deepEqual(limitOf("vehicles.1.ate_m.below:1e-3"), {base: "vehicles.1.ate_m", below: true, limit: 0.001});
  assert.equal(limitOf("ate_m"), undefined);
});

test("differences pair equal seeds, and name those that are left out", () => {
  const {points, leftOut} = differencesOf(runs(), "b", "a", "ate_m");
  assert.deepEqual(points, [{seed: 1, x: 0.25, value: 0.75, baseline: 0.5}, {seed: 2, x: -0.125, value: 0.125, baseline: 0.25}]);
  assert.deepEqual(leftOut, [{seed: 3, why: "failed in the baseline: lost, at the end"}, {seed: 4, why: "failed: crashed"}]);
});

test("a run without a value is left out of that measure alone", () => {
  const {points, leftOut} = differencesOf(runs(), "b", "a", "entropy.total");
  assert.deepEqual(seeds(points), [1]);
  assert.deepEqual(leftOut[0], {seed: 2, why: "no value in the baseline"});
  assert.deepEqual(differencesOf(runs(), "b", "a", "failed").points.map(({x}) => x), [0, 0, -1, 1]);
  assert.deepEqual(differencesOf(runs(), "b", "a", "failed").leftOut, []);
});

test("values of a variant hold every run that ended once", () => {
  const {points, leftOut} = valuesOf(runs(), "b", "ate_m");
  assert.deepEqual(seeds(points), [1, 2, 3, 5]);
  assert.deepEqual(leftOut, [{seed: 4, why: "failed: crashed"}]);
});

test("jitter is the same for a seed, within bounds, and spreads consecutive seeds", () => {
  const all = Array.from({length: 1000}, (_, i) => jitter(i + 1));
  assert.ok(all.every((y) => y >= -1 && y < 1));
  assert.deepEqual(all, Array.from({length: 1000}, (_, i) => jitter(i + 1)));
  for (let i = 1; i < all.length; ++i) assert.ok(Math.abs(all[i] - all[i - 1]) > 0.3);
  const quarters = [0, 0, 0, 0];
  all.forEach((y) => ++quarters[Math.floor(2 * (y + 1))]);
  assert.ok(quarters.every((count) => count > 240 && count < 260), String(quarters));
});

test("units follow the names of the measures", () => {
  for (const [measure, unit] of [["ate_m", "m"], ["entropy.total", "nats"], ["exploration.entropy_extended", "nats"],
    ["exploration.t_14_located_s", "s"], ["vehicles.1.from_path_m.p95", "m"], ["drift_percent", "%"], ["mean_nis", ""],
    ["lost_frames", "frames"], ["consistency.frames_with_truth", "frames"], ["map_error_landmarks", "landmarks"],
    ["failed", "share of runs"], ["ate_m.below:0.1", "share of runs"], ["exploration.coverage", ""], ["decisions", ""],
    ["exploration.mapped", ""], ["exploration.mapped_60_s", ""], ["exploration.t_90_mapped_s", "s"],
    ["exploration.within_5_cm", ""]])
    assert.equal(unitOf(measure), unit, measure);
  assert.equal(labelOf("ate_m"), "ate_m (m)");
  assert.equal(labelOf("mean_nis"), "mean_nis");
  assert.match(aboutOf("ate_m.above:2"), /done with ate_m above 2/);
  assert.match(aboutOf("vehicles.2.ate_m"), /position error, vehicle 2/);
});

test("short names of variants stay distinct", () => {
  const names = (...list) => [...shortNames(list.map((name) => ({name}))).values()];
  assert.deepEqual(names("decision.strategy=none points.count=12", "decision.strategy=random points.count=12"),
    ["strategy=none count=12", "strategy=random count=12"]);
  assert.deepEqual(names("plant.sigma=1", "sensor.sigma=1"), ["plant.sigma=1", "sensor.sigma=1"]);
  assert.deepEqual(names("points.size_m=[20.5, 3]"), ["size_m=[20.5, 3]"]);
  assert.deepEqual(names("room"), ["room"]);
});

test("numbers keep four digits, and unknown ones show as such", () => {
  assert.equal(shown(-93.3649), "\u221293.36");
  assert.equal(shown(0.0006917), "0.0006917");
  assert.equal(shown(1.23456e-7), "1.235e\u22127");
  assert.equal(shown(0), "0");
  assert.equal(shown(null), "–");
  assert.equal(withInterval(1, null, null), "1");
  assert.equal(withInterval(1, 0.5, 1.5), "1 (0.5 to 1.5)");
});

test("an interval shows a direction only without 0", () => {
  const of = (low, high, pairs = 9) => directionOf({low, high, pairs});
  assert.deepEqual([of(-2, -1), of(1, 2), of(-1, 1), of(0, 1), of(0, 0), of(null, null), directionOf(undefined)],
    ["lower", "higher", "open", "open", "equal", "unknown", "unknown"]);
});

test("ranges hold all numbers, and are never empty", () => {
  const [least, most] = rangeOf([1, 3], true);
  assert.ok(least < 0 && most > 3);
  assert.ok(rangeOf([80, 80], false)[0] < 80 && rangeOf([80, 80], false)[1] > 80);
  for (const numbers of [[], [NaN], [0]]) assert.ok(rangeOf(numbers, true)[0] < rangeOf(numbers, true)[1]);
});

test("ticks of a symmetric-logarithmic axis are 0 and powers of ten on both sides", () => {
  assert.equal(linearPart([0.03, -0.04, 2]), 0.01);
  assert.equal(linearPart([0]), 1);
  assert.deepEqual(symlogTicks([-0.5, 20], 0.01, 20), [-0.1, -0.01, 0, 0.01, 0.1, 1, 10]);
  const few = symlogTicks([-1e6, 1e6], 1, 7);
  assert.ok(few.length <= 7 && few.includes(0), String(few));
});
