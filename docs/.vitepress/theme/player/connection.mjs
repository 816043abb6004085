// A worker and its answers, as promises. What it says unasked goes to `hear`.
export class Connection {
  constructor(address, hear = () => {}) {
    this.worker = new Worker(address, { type: 'module' })
    this.waiting = new Map()
    this.next = 0
    this.worker.addEventListener('message', ({ data }) => {
      if (data.id === undefined) return hear(data)
      const { resolve, reject } = this.waiting.get(data.id)
      this.waiting.delete(data.id)
      if (data.error === undefined) resolve(data)
      else reject(new Error(data.error))
    })
    this.worker.addEventListener('error', (event) => this.refuse(event.message || 'the worker does not start'))
  }

  ask(call, words = {}) {
    return new Promise((resolve, reject) => {
      const id = this.next++
      this.waiting.set(id, { resolve, reject })
      this.worker.postMessage({ id, call, ...words })
    })
  }

  refuse(why) {
    for (const { reject } of this.waiting.values()) reject(new Error(why))
    this.waiting.clear()
  }

  // Whatever it does; those who wait get an error.
  end(why) {
    this.worker.terminate()
    this.refuse(why)
  }
}
