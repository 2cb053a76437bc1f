// Undo and redo of whole values.

const most = 200;

export class History<T> {
    private past: T[] = [];
    private future: T[] = [];

    constructor(private present: T) {}

    get value(): T {
        return this.present;
    }

    get undoable(): boolean {
        return this.past.length > 0;
    }

    get redoable(): boolean {
        return this.future.length > 0;
    }

    /** Adds a step that can be undone. */
    push(value: T): void {
        this.past.push(this.present);
        if (this.past.length > most) this.past.shift();
        this.present = value;
        this.future = [];
    }

    undo(): T {
        const before = this.past.pop();
        if (before === undefined) return this.present;
        this.future.push(this.present);
        return (this.present = before);
    }

    redo(): T {
        const after = this.future.pop();
        if (after === undefined) return this.present;
        this.past.push(this.present);
        return (this.present = after);
    }

    /** All steps before and after the present one, the nearest last. */
    get steps(): { past: readonly T[]; future: readonly T[] } {
        return { past: this.past, future: this.future };
    }

    /** Starts with another value; earlier steps can be undone only if they are given. */
    begin(value: T, past: readonly T[] = [], future: readonly T[] = []): void {
        this.past = past.slice(-most);
        this.future = [...future];
        this.present = value;
    }
}
