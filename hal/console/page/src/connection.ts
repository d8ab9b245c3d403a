// SPDX-License-Identifier: Apache-2.0
// The WebSocket to the program: comes back by itself, waits longer after each failure.
//
// States: connecting, open, waiting (for the next try), closed (for good: wrong protocol).
// The token of the page's address goes along with everything asked of the server.
import {decode, kProtocol, type FromServer} from './protocol';

export type ConnectionState = 'connecting'|'open'|'waiting'|'closed';
const kFirstWaitMs = 500;
const kLongestWaitMs = 10000;
// A page whose pointer outruns the network drops positions instead of queueing them.
const kMostQueuedBytes = 65536;

export interface ConnectionStatus {
  state: ConnectionState;
  retryAt: number;  // performance.now() of the next try, while waiting
  theirs: number;   // protocol of the server, while closed
}

export function withToken(path: string, page: Location): URL {
  const url = new URL(path, page.href);
  const token = new URLSearchParams(page.search).get('token');
  url.search = token === null ? '' : `?${new URLSearchParams({token}).toString()}`;
  return url;
}

// Half of what is doubled each time is left to chance, so that many pages do not return at once.
export function waitMs(failures: number, chance: number): number {
  const longest = Math.min(kLongestWaitMs, kFirstWaitMs * 2 ** Math.max(0, failures - 1));
  return longest * (0.5 + 0.5 * chance);
}

export class Connection {
  readonly link: ConnectionStatus = {state: 'connecting', retryAt: 0, theirs: 0};
  private socket: WebSocket|null = null;
  private failures = 0;
  private timer = 0;

  constructor(
      private readonly heard: (message: FromServer) => void,
      private readonly changed: () => void,
      private readonly garbled: () => void,
      private readonly timed: (work: () => void) => void,
  ) {}

  open(): void {
    window.clearTimeout(this.timer);
    this.socket?.close();
    const url = withToken('ws', window.location);
    url.protocol = url.protocol === 'https:' ? 'wss:' : 'ws:';
    const socket = new WebSocket(url);
    socket.binaryType = 'arraybuffer';
    this.socket = socket;
    this.enter('connecting');
    socket.onopen = () => this.enter('open');
    socket.onmessage = (event) => {
      if (socket === this.socket) this.timed(() => this.take(event.data));
    };
    socket.onclose = () => socket === this.socket && this.lost();
  }

  send(bytes: Uint8Array): boolean {
    const socket = this.socket;
    if (socket === null || socket.readyState !== WebSocket.OPEN) return false;
    if (socket.bufferedAmount > kMostQueuedBytes) return false;
    socket.send(bytes as Uint8Array<ArrayBuffer>);
    return true;
  }

  private take(data: unknown): void {
    const message = data instanceof ArrayBuffer ? decode(data) : null;
    if (message === null) {
      this.garbled();
      return;
    }
    if (message.kind === 'hello') {
      if (message.protocol !== kProtocol) {
        this.link.theirs = message.protocol;
        const socket = this.socket;
        this.socket = null;
        socket?.close();
        this.enter('closed');
        return;
      }
      this.failures = 0;
    }
    this.heard(message);
  }

  private lost(): void {
    this.socket = null;
    ++this.failures;
    const wait = waitMs(this.failures, Math.random());
    this.link.retryAt = performance.now() + wait;
    this.timer = window.setTimeout(() => this.open(), wait);
    this.enter('waiting');
  }

  private enter(state: ConnectionState): void {
    this.link.state = state;
    this.changed();
  }
}
