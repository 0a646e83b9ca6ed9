// The computer at the other end of a Pico's USB: an RP2040 of rp2040js runs the file of `stiction image`, and the computer acts
// as after plugging in the board: bus reset, address, descriptors, configuration, serial line. It replaces the class USBCDC of
// rp2040js, which requests no texts, addresses the line's requests to the device instead of its interface, and answers when a
// computer with nothing to send would stay silent.

import assert from "node:assert/strict";
import { ConsoleLogger, createSetupPacket, LogLevel, Simulator } from "rp2040js";

/** Cycles per ms, and nanoseconds per cycle. */
export const MS = 125_000;
const CYCLE = 8;
/** Longest time to an answer (ms). */
const PATIENCE = 1000;
/** Largest packet (bytes). */
const PACKET = 64;
/** Time of a packet on the bus, at 12 Mbit/s including overhead (ns). */
const ON_THE_BUS = 50_000;
/**
 * Bit by which an endpoint offers its data to the computer; address of the buffer control of endpoint 0 to the computer, and
 * bytes to the next one.
 */
const AVAILABLE = 1 << 10;
const [FIRST_CONTROL, CONTROLS] = [0x80, 8];
/** The interrupt of USB, and that of the calendar, by which the program requests a turn: there are no others. */
const [USB_IRQ, TURN_IRQ] = [5, 25];
/** Bits of a request: to the computer; of the class, to an interface. */
const IN = 0x80;
const CLASS = 0x20;
const INTERFACE = 1;
/** Requests (USB 2.0, table 9-4; CDC PSTN 1.2, table 13). */
const SET_ADDRESS = 5;
const GET_DESCRIPTOR = 6;
const SET_CONFIGURATION = 9;
const SET_LINE_CODING = 0x20;
const SET_CONTROL_LINE_STATE = 0x22;
/** Descriptors (USB 2.0, table 9-5). */
const DEVICE = 1;
const CONFIGURATION = 2;
const STRING = 3;
/** English. */
const LANGUAGE = 0x409;

/**
 * Writes the contents of a UF2 file, block by block.
 * @param {Uint8Array} file @param {Uint8Array} flash its first byte lies at 0x10000000
 */
function write(file, flash) {
  const view = new DataView(file.buffer, file.byteOffset, file.byteLength);
  for (let at = 0; at < file.length; at += 512) {
    const word = (/** @type {number} */ offset) => view.getUint32(at + offset, true);
    assert.deepEqual([word(0), word(4), word(508)], [0x0a324655, 0x9e5d5157, 0x0ab16f30]);
    assert.deepEqual([word(20), word(24), word(28)], [at / 512, file.length / 512, 0xe48bff56]);
    flash.set(file.subarray(at + 32, at + 32 + word(16)), word(12) - 0x10000000);
  }
}

/** @typedef {{data: number[], out: Uint8Array, length: number, isIn: boolean, status: boolean, done: boolean}} Transfer */

/** A Pico on the USB of a computer. Time advances only in `run`. */
export class UsbHost {
  /** @param {Uint8Array} file what is copied to its drive */
  constructor(file) {
    const { clock, rp2040 } = new Simulator();
    this.clock = clock;
    this.chip = rp2040;
    this.chip.logger = new ConsoleLogger(LogLevel.Error, true);
    write(file, this.chip.flash);
    this.cycles = 0;
    /** Cycles in which it did not sleep. */
    this.busy = 0;
    this.isReset = false;
    /** Receives the bytes of the serial line. @type {(bytes: Uint8Array) => void} */
    this.take = () => {};
    /** Endpoints of the serial line. */
    this.line = { in: -1, out: -1, control: -1 };
    /** Number of bytes that each endpoint can take at present. @type {Map<number, number>} */
    this.room = new Map();
    /** Bytes not yet transferred to the board over the serial line. @type {number[]} */
    this.waiting = [];
    /** @type {Transfer | null} */
    this.transfer = null;
    this.wire();
    this.boot();
  }

  /** Connects the two ends. */
  wire() {
    const { usbCtrl: usb, core } = this.chip;
    usb.onUSBEnabled = () => usb.resetDevice();
    usb.onResetReceived = () => {
      this.isReset = true;
    };
    usb.onEndpointWrite = (endpoint, bytes) => {
      if (endpoint === 0) this.answered(bytes);
      else if (endpoint === this.line.in) this.take(bytes);
    };
    usb.onEndpointRead = (endpoint, size) => {
      this.room.set(endpoint, size);
      this.pump(endpoint);
    };
    // rp2040js takes a packet in no time, and a board that writes byte by byte would send each byte in its own packet.
    const taken = usb.DPRAMUpdated.bind(usb);
    const buses = Array.from({ length: 16 }, (_, endpoint) => this.clock.createAlarm(() => {
      const offset = FIRST_CONTROL + CONTROLS * endpoint;
      taken(offset, this.chip.usbDPRAMView.getUint32(offset, true));
    }));
    usb.DPRAMUpdated = (offset, value) => {
      const endpoint = (offset - FIRST_CONTROL) / CONTROLS;
      if (!(value & AVAILABLE) || !buses[endpoint]) taken(offset, value);
      else buses[endpoint].schedule(ON_THE_BUS);
    };
    // In rp2040js, an interrupt requested by the program itself stays pending after it has begun: from there on only its line
    // counts.
    const enter = core.exceptionEntry.bind(core);
    core.exceptionEntry = (number) => {
      enter(number);
      // It leaves the lowest bit of the vector in PC, which makes PC-relative addresses odd: a jump table is read one byte
      // late.
      core.PC &= ~1;
      if (number === 16 + USB_IRQ) this.chip.setInterrupt(USB_IRQ, usb.intStatus !== 0);
      if (number === 16 + TURN_IRQ) this.chip.setInterrupt(TURN_IRQ, false);
    };
  }

  /** Starts as the boot program of the chip does: the second boot stage comes next, which continues to the image if LR is 0. */
  boot() {
    const { core } = this.chip;
    core.SP = 0x20041f00;
    core.LR = 0;
    core.PC = 0x10000000;
  }

  /** @param {number} cycles */
  run(cycles) {
    const { clock, chip: { core } } = this;
    const end = this.cycles + cycles;
    while (this.cycles < end) {
      if (core.waiting) {
        const asleep = Math.min(Math.max(Math.ceil(clock.nanosToNextAlarm / CYCLE), 1), end - this.cycles);
        clock.tick(asleep * CYCLE);
        this.cycles += asleep;
      } else {
        const taken = core.executeInstruction();
        clock.tick(taken * CYCLE);
        this.cycles += taken;
        this.busy += taken;
      }
    }
  }

  /** Advances time until a condition is true. @param {() => unknown} isSo @param {string} what */
  until(isSo, what) {
    for (let tenths = 0; tenths < 10 * PATIENCE; tenths++) {
      if (isSo()) return;
      this.run(MS / 10);
    }
    assert.fail(`no ${what} in ${PATIENCE} ms`);
  }

  /** Sends waiting data, as far as the board has room. @param {number} endpoint */
  pump(endpoint) {
    const room = this.room.get(endpoint);
    const bytes = room === undefined ? null : this.next(endpoint, room);
    if (!bytes) return;
    this.room.delete(endpoint);
    this.chip.usbCtrl.endpointReadDone(endpoint, bytes);
  }

  /** Returns the next packet to an endpoint, or none. @param {number} endpoint @param {number} room */
  next(endpoint, room) {
    if (endpoint === this.line.out && this.waiting.length > 0) return Uint8Array.from(this.waiting.splice(0, room));
    const { transfer } = this;
    if (endpoint !== 0 || !transfer) return null;
    // An empty packet ends what the board has sent.
    if (transfer.isIn && transfer.status) {
      transfer.done = true;
      return new Uint8Array(0);
    }
    const { out } = transfer;
    transfer.out = new Uint8Array(0);
    return out.length > 0 ? out : null;
  }

  /** Takes the board's answer on endpoint 0. @param {Uint8Array} bytes */
  answered(bytes) {
    const { transfer } = this;
    assert.ok(transfer && !transfer.done, "an answer to nothing");
    if (!transfer.isIn) {
      assert.deepEqual([bytes.length, transfer.out.length], [0, 0]);
      transfer.done = true;
      return;
    }
    transfer.data.push(...bytes);
    transfer.status = bytes.length < PACKET || transfer.data.length >= transfer.length;
    if (transfer.status) this.pump(0);
  }

  /**
   * Makes a request and returns its answer.
   * @param {number} kind @param {number} request @param {number} value @param {number} index
   * @param {number} length of the answer, at most @param {Uint8Array} out what is sent with it
   */
  control(kind, request, value, index, length = 0, out = new Uint8Array(0)) {
    const isIn = (kind & IN) !== 0;
    const transfer = { data: [], out, length, isIn, status: false, done: false };
    this.transfer = transfer;
    this.room.delete(0);
    this.chip.usbCtrl.sendSetupPacket(createSetupPacket({
      dataDirection: kind >> 7,
      type: (kind >> 5) & 3,
      recipient: kind & 31,
      bRequest: request,
      wValue: value,
      wIndex: index,
      wLength: isIn ? length : out.length,
    }));
    this.until(() => transfer.done, `answer to request ${request} (${value})`);
    this.run(MS);
    return Uint8Array.from(transfer.data);
  }

  /** @param {number} kind @param {number} index @param {number} length @param {number} language */
  descriptor(kind, index, length, language = 0) {
    return this.control(IN, GET_DESCRIPTOR, (kind << 8) | index, language, length);
  }

  /** Returns a text of the board, "" for none. @param {number} index */
  text(index) {
    if (index === 0) return "";
    const bytes = this.descriptor(STRING, index, 255, LANGUAGE);
    assert.deepEqual([bytes[0], bytes[1]], [bytes.length, STRING]);
    return new TextDecoder("utf-16le").decode(bytes.subarray(2));
  }

  /** Plugs the board in again, which ran on meanwhile: all waiting data are lost. */
  plugAgain() {
    this.isReset = false;
    this.room.clear();
    this.waiting = [];
    this.chip.usbCtrl.resetDevice();
    return this.enumerate();
  }

  /**
   * Keeps the bus silent for longer than 3 ms, as when the plug is pulled from a board with its own supply, or the computer
   * sleeps.
   */
  fallSilent() {
    /** Bit of the register SIE_STATUS; rp2040js defines it, but not how a program clears it. */
    const SUSPENDED = 1 << 4;
    const usb = /** @type {any} */ (this.chip.usbCtrl);
    usb.sieStatus |= SUSPENDED;
    usb.sieStatusUpdated();
    this.run(MS / 10);
    usb.sieStatus &= ~SUSPENDED;
    usb.sieStatusUpdated();
  }

  /** Runs from plugging in to the configuration; returns what the board reports about itself. */
  enumerate() {
    this.until(() => this.isReset, "reset of the bus");
    this.run(10 * MS);
    const first = this.descriptor(DEVICE, 0, 8);
    assert.deepEqual([...first.subarray(0, 2), first[7]], [18, DEVICE, PACKET]);
    const address = 5;
    this.control(0, SET_ADDRESS, address, 0);
    assert.equal(this.chip.usbCtrl.readUint32(0), address);
    const device = this.descriptor(DEVICE, 0, 18);
    assert.equal(device.length, 18);
    const head = this.descriptor(CONFIGURATION, 0, 9);
    const length = head[2] | (head[3] << 8);
    const all = this.descriptor(CONFIGURATION, 0, length);
    assert.equal(all.length, length);
    this.findLine(all);
    const said = {
      vendor: device[8] | (device[9] << 8),
      product: device[10] | (device[11] << 8),
      texts: [device[14], device[15], device[16]].map((index) => this.text(index)),
    };
    this.control(0, SET_CONFIGURATION, head[5], 0);
    return said;
  }

  /** Finds the serial line among the descriptors of a configuration. @param {Uint8Array} all */
  findLine(all) {
    /** Classes of interfaces (USB-IF), and kinds of descriptors. */
    const [COMMUNICATION, DATA, OF_INTERFACE, OF_ENDPOINT, BULK] = [2, 10, 4, 5, 2];
    let kind = 0;
    for (let at = 0; at < all.length; at += all[at]) {
      const [, type, address, attributes] = all.subarray(at, at + 4);
      if (type === OF_INTERFACE) {
        kind = all[at + 5];
        if (kind === COMMUNICATION) this.line.control = address;
      } else if (type === OF_ENDPOINT && kind === DATA) {
        assert.equal(attributes & 3, BULK);
        this.line[address & IN ? "in" : "out"] = address & 15;
      }
    }
    assert.ok(Object.values(this.line).every((number) => number >= 0));
  }

  /** Opens or closes the serial line, as a program does. @param {boolean} isOpen */
  open(isOpen) {
    const [kind, index] = [CLASS | INTERFACE, this.line.control];
    // 115200 baud, 8N1: the values do not matter.
    const coding = Uint8Array.from([0, 0xc2, 1, 0, 0, 0, 8]);
    if (isOpen) this.control(kind, SET_LINE_CODING, 0, index, 0, coding);
    // DTR and RTS.
    this.control(kind, SET_CONTROL_LINE_STATE, isOpen ? 3 : 0, index);
  }

  /** Sends bytes when the board takes them. @param {Uint8Array} bytes */
  send(bytes) {
    this.waiting.push(...bytes);
    this.pump(this.line.out);
  }
}
