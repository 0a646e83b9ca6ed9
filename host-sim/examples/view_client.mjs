// A client of `stiction view`: prints poses; with --drag, it also moves the hand.
//
//     cargo run --release -- view --headless
//     node host-sim/examples/view_client.mjs [--drag] [HOST:PORT]
//
// It needs a WebSocket as in browsers, which Node.js has since version 22 (20 and 21: --experimental-websocket).
// host-sim/VIEW.md describes the messages on the socket.

if (typeof WebSocket === 'undefined') {
  console.error('This Node.js has no WebSocket: run it with --experimental-websocket, or take Node.js 22 or newer.');
  process.exit(2);
}
const drags = process.argv.includes('--drag');
const place = process.argv.slice(2).find((word) => !word.startsWith('--')) ?? '127.0.0.1:8405';
const socket = new WebSocket(`ws://${place}/ws`);
const send = (message) => socket.send(JSON.stringify(message));

/** Presses the body down from the hand's start pose, and drags it back and forth. */
function drag([x, y, phi]) {
  const begun = performance.now();
  setInterval(() => {
    const t = (performance.now() - begun) / 1000;
    const down = Math.min(t, 1) * 0.03;
    const along = t > 1 ? 0.05 * (1 - Math.abs((t % 8) / 4 - 1)) : 0;
    send({ type: 'hand', pose: [x + along, y - down, phi], held: true, sent: t });
  }, 10);
}

let leads = false;
const take = {
  hello: ({ program, you }) => console.log(`${program}, client ${you}`),
  state: ({ scene, hand }) => {
    console.log(`scene ${scene.title}, hand by ${hand.by}`);
    if (drags && !leads) {
      leads = true;
      drag(scene.home);
    }
  },
  frame: ({ frame, counts }) => {
    const [x, y, theta] = frame.pose;
    console.log(
      `${frame.t.toFixed(3)} s  x ${(1e3 * x).toFixed(3)} mm  y ${(1e3 * y).toFixed(3)} mm  ` +
        `theta ${theta.toFixed(4)} rad  ${frame.state}  slips ${counts.slips}`,
    );
  },
  error: ({ message }) => console.log(`refused: ${message}`),
};
socket.addEventListener('open', () => send({ type: 'rate', value: 10 }));
socket.addEventListener('message', ({ data }) => {
  const message = JSON.parse(data);
  take[message.type]?.(message);
});
socket.addEventListener('error', () => console.log(`nobody answers at ${place}`));
socket.addEventListener('close', () => process.exit());
