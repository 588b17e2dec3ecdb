// Signal with listeners.

export class Signal {
  #listeners = new Set();

  connect(listener) {
    this.#listeners.add(listener);
  }

  disconnect(listener) {
    this.#listeners.delete(listener);
  }

  emit(...values) {
    for (const listener of this.#listeners) {
      try {
        listener(...values);
      } catch (error) {
        console.error("slamlab:", error); // a failing listener must not stop the lecture
      }
    }
  }
}
