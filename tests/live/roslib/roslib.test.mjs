// The simulated robot as roslib, the JavaScript client of rosbridge, sees it.
import definitions from '@foxglove/rosmsg-msgs-common';
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { readFileSync, rmSync } from 'node:fs';
import test from 'node:test';
import { Ros, Topic } from 'roslib';

const program = process.env.INCOGNITA ?? 'incognita';

/** @param {Promise<any>} promise @param {string} what */
function before(promise, what) {
  let timer;
  const late = new Promise((_, reject) => {
    timer = setTimeout(() => reject(new Error(`waited in vain for ${what}`)), 30000);
  });
  return Promise.race([promise, late]).finally(() => clearTimeout(timer));
}

/** A simulated robot and a connection to it. @param {string[]} args */
async function connected(t, folder, args = []) {
  rmSync(folder, { recursive: true, force: true });
  const child = spawn(program, ['robot', 'explore-terrain', '--port', '0', '--out', folder, ...args], {
    stdio: ['ignore', 'ignore', 'pipe'],
  });
  const exited = new Promise((resolve) => child.on('exit', resolve));
  const ros = new Ros({});
  const end = async () => {
    child.kill('SIGINT');
    await before(exited, 'the end of the robot');
  };
  t.after(async () => {
    ros.close();
    await end();
  });
  let output = '';
  const address = await before(new Promise((resolve, reject) => {
    child.stderr.on('data', (bytes) => {
      output += bytes;
      const found = output.match(/the robot is at (ws:[^,\s]+)/);
      if (found) resolve(found[1]);
    });
    exited.then((code) => reject(new Error(`the robot ended with ${code}: ${output}`)));
  }), 'the address');
  ros.connect(address);
  await before(new Promise((resolve, reject) => {
    ros.on('connection', resolve);
    ros.on('error', reject);
  }), 'the connection');
  return { ros, end, folder };
}

/** The first message that fits. */
function message(ros, name, messageType, fits = () => true) {
  const topic = new Topic({ ros, name, messageType });
  return before(new Promise((resolve) => {
    topic.subscribe((received) => {
      if (!fits(received)) return;
      topic.unsubscribe();
      resolve(received);
    });
  }), name);
}

/** Fails unless a message has exactly the fields of its definition, and these their types. @param {string} path for errors */
function conforms(all, value, type, path) {
  const fields = all[type].definitions.filter((field) => !field.isConstant);
  assert.deepEqual(Object.keys(value).sort(), fields.map((field) => field.name).sort(), path);
  for (const { name, type: of, isComplex, isArray, arrayLength } of fields) {
    const at = `${path}.${name}`, found = value[name];
    if (/^u?int8$/.test(of) && isArray) assert.equal(typeof found, 'string', at);
    else if (isArray) {
      assert.ok(Array.isArray(found) && found.every((x) => typeof x === 'number'), at);
      if (arrayLength) assert.equal(found.length, arrayLength, at);
    } else if (/^(time|duration)$/.test(of)) {
      const [s, ns] = all === definitions.ros1 ? ['secs', 'nsecs'] : ['sec', 'nanosec'];
      assert.deepEqual(Object.keys(found).sort(), [s, ns].sort(), at);
      assert.ok(Number.isInteger(found[s]) && Number.isInteger(found[ns]) && found[ns] < 1e9, at);
    } else if (isComplex) conforms(all, found, of, at);
    else assert.equal(typeof found, { string: 'string', bool: 'boolean' }[of] ?? 'number', at);
  }
}

for (const [generation, names] of [['1', ['secs', 'nsecs']], ['2', ['sec', 'nanosec']]])
  test(`images, calibration and odometry have the fields of ROS ${generation}`, async (t) => {
    const { ros } = await connected(t, `ros${generation}`, ['--ros', generation]);
    const middle = generation === '2' ? 'msg/' : '';
    const all = generation === '1' ? definitions.ros1 : definitions.ros2jazzy;
    const image = await message(ros, '/camera/image_raw/compressed', `sensor_msgs/${middle}CompressedImage`);
    assert.deepEqual(Object.keys(image.header.stamp).sort(), [...names].sort());
    conforms(all, image, 'sensor_msgs/CompressedImage', 'image');
    assert.equal(image.format, 'jpeg');
    const bytes = Buffer.from(image.data, 'base64');
    assert.deepEqual([...bytes.subarray(0, 3)], [0xff, 0xd8, 0xff]);
    assert.ok(Math.abs(image.header.stamp[names[0]] - Date.now() / 1000) < 5, 'the clock is that of the machine');
    const info = await message(ros, '/camera/camera_info', `sensor_msgs/${middle}CameraInfo`);
    conforms(all, info, 'sensor_msgs/CameraInfo', 'info');
    assert.equal(info.width, 320);
    assert.equal(info[generation === '2' ? 'k' : 'K'][0], 195);
    const odometry = await message(ros, '/odom', `nav_msgs/${middle}Odometry`);
    conforms(all, odometry, 'nav_msgs/Odometry', 'odometry');
    assert.equal(odometry.twist.twist.linear.x, 0);
    assert.equal(odometry.pose.covariance.length, 36);
  });

test('a published Twist drives the robot, and it stops by itself', async (t) => {
  const { ros, end, folder } = await connected(t, 'drive', ['--watchdog', '0.4']);
  const command = new Topic({ ros, name: '/cmd_vel', messageType: 'geometry_msgs/Twist' });
  command.advertise();
  const driving = setInterval(
    () => command.publish({ linear: { x: -0.1, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0.2 } }), 50);
  t.after(() => clearInterval(driving));
  const moving = await message(ros, '/odom', 'nav_msgs/Odometry', (m) => m.twist.twist.linear.x !== 0);
  assert.equal(moving.twist.twist.linear.x, -0.1);
  assert.equal(moving.twist.twist.angular.z, 0.2);
  clearInterval(driving);
  const stopped = await message(ros, '/odom', 'nav_msgs/Odometry', (m) => m.twist.twist.linear.x === 0);
  assert.ok(stopped.pose.pose.position.x < 0, 'it went backwards');
  await end();
  const rows = readFileSync(`${folder}/robot.csv`, 'utf8').trim().split('\n').slice(1).map((row) => row.split(','));
  const drove = rows.filter((row) => Number(row[3]) !== 0);
  assert.ok(drove.length > 0);
  for (const [time, , commanded] of drove) assert.ok(Number(time) - Number(commanded) < 0.4001);
  assert.match(rows.at(-1)[1], /silence/);
});

test('a stop holds until it is released', async (t) => {
  const { ros } = await connected(t, 'stop');
  const command = new Topic({ ros, name: '/cmd_vel', messageType: 'geometry_msgs/TwistStamped' });
  const stop = new Topic({ ros, name: '/stop', messageType: 'std_msgs/Bool' });
  const driving = setInterval(() => command.publish({ twist: { linear: { x: -0.1 } } }), 50);
  t.after(() => clearInterval(driving));
  const moves = (m) => m.twist.twist.linear.x !== 0;
  await message(ros, '/odom', 'nav_msgs/Odometry', moves);
  stop.publish({ data: true });
  await message(ros, '/odom', 'nav_msgs/Odometry', (m) => !moves(m));
  await assert.rejects(Promise.race([
    message(ros, '/odom', 'nav_msgs/Odometry', moves),
    new Promise((_, reject) => { setTimeout(() => reject(new Error('still')), 700); }),
  ]), /still/);
  stop.publish({ data: false });
  await message(ros, '/odom', 'nav_msgs/Odometry', moves);
});

test('a service that does not exist is refused, and the robot goes on', async (t) => {
  const { ros } = await connected(t, 'services');
  const refused = new Promise((resolve) => { ros.getTopics(() => resolve('answered'), () => resolve('refused')); });
  assert.equal(await before(refused, 'the answer'), 'refused');
  await message(ros, '/odom', 'nav_msgs/Odometry');
});
