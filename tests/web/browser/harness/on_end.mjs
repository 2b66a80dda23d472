// What to do after a test, the last first: a page closes before its program ends.

/** @type {WeakMap<import('node:test').TestContext, (() => unknown)[]>} */
const tasks = new WeakMap();

/** @param {import('node:test').TestContext} t @param {() => unknown} task */
export function onEnd(t, task) {
  const known = tasks.get(t);
  if (known) return known.push(task);
  const stack = [task];
  tasks.set(t, stack);
  t.after(async () => {
    const failures = [];
    for (let next = stack.pop(); next; next = stack.pop()) {
      try {
        await next();
      } catch (error) {
        failures.push(error);
      }
    }
    if (failures.length > 0) throw failures[0];
  });
}
