// Undo and redo over whole values: each step is the value as it was.

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

    /** A step that can be taken back. */
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

    /** Another thing altogether: nothing of before can come back. */
    begin(value: T): void {
        this.past = [];
        this.future = [];
        this.present = value;
    }
}
