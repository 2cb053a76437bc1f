// Numbers of a year as paths of a graph: days to pixels, dates, bars, lines and stacked areas. Pure.
import { lastDay } from "./view_address";

const months = ["Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"];
const lengths = [31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];

/** A strip of a graph, pixels. */
export interface Strip {
    left: number;
    right: number;
    top: number;
    bottom: number;
}

/** Returns the first day of each month, from 1 on. */
export function monthStarts(): { name: string; day: number }[] {
    let day = 1;
    return lengths.map((length, index) => {
        const start = { name: months[index] ?? "", day };
        day += length;
        return start;
    });
}

/** Returns a day of the year as a date: "27 Sep" for 270. */
export function dateOf(day: number): string {
    const month = monthStarts()[monthOf(day) - 1] ?? { name: "Jan", day: 1 };
    return `${day - month.day + 1} ${month.name}`;
}

/** Returns the month of a day, from 1 on. */
export function monthOf(day: number): number {
    return monthStarts().filter((one) => one.day <= day).length;
}

/** Returns where the middle of a day is. */
export function xOfDay(day: number, { left, right }: Strip): number {
    return left + ((day - 0.5) / lastDay) * (right - left);
}

/** Returns the day at a place of the strip. */
export function dayAtX(x: number, { left, right }: Strip): number {
    const day = Math.floor(((x - left) / (right - left)) * lastDay) + 1;
    return Math.min(Math.max(day, 1), lastDay);
}

function point(x: number, y: number): string {
    return `${x.toFixed(1)},${y.toFixed(1)}`;
}

/** Returns a number that is as round as it can be, and not less. */
export function roundAbove(value: number): number {
    if (value <= 0) return 1;
    const power = 10 ** Math.floor(Math.log10(value));
    return ([1, 1.2, 1.6, 2, 3, 4, 6, 8, 10].find((step) => step * power >= value * 0.9999999) ?? 10) * power;
}

/** Returns bars from the bottom of the strip, the highest of `most` as high as the strip. */
export function bars(values: readonly number[], most: number, strip: Strip): string {
    const width = (strip.right - strip.left) / lastDay;
    return values
        .flatMap((value, index) => {
            const height = (Math.min(value / most, 1) * (strip.bottom - strip.top)).toFixed(1);
            if (Number(height) === 0) return [];
            return [`M${point(strip.left + index * width, strip.bottom)}v-${height}h${(width * 0.8).toFixed(2)}v${height}z`];
        })
        .join("");
}

/** Returns a line; `from` is at the bottom of the strip and `to` at its top. */
export function line(values: readonly number[], from: number, to: number, strip: Strip): string {
    const y = (value: number): number => strip.bottom - ((value - from) / (to - from)) * (strip.bottom - strip.top);
    return values.map((value, index) => `${index === 0 ? "M" : "L"}${point(xOfDay(index + 1, strip), y(value))}`).join("");
}

/** Returns the line of each series above the bottom of the strip, "" for one of zeros. Heights grow with the square
 *  root, so that a few agarics are seen beside hundreds of brackets; `most` is as high as the strip. */
export function rootLines(series: readonly (readonly number[])[], most: number, strip: Strip): string[] {
    const y = (value: number): number => strip.bottom - Math.sqrt(value / most) * (strip.bottom - strip.top);
    return series.map((values) => {
        if (values.every((value) => value === 0)) return "";
        return values.map((value, index) => `${index === 0 ? "M" : "L"}${point(xOfDay(index + 1, strip), y(value))}`).join("");
    });
}

/** Returns the greatest number of all series. */
export function greatest(series: readonly (readonly number[])[]): number {
    return Math.max(0, ...series.map((values) => Math.max(0, ...values)));
}
