// What a tag or a point has at an instant; null: nobody knows.

export type Value = number | null;
