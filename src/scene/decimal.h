/* decimal.h - reads decimal numbers from text, quickly and exactly.
 *
 * strtod alone would do, but takes half of the time of loading a mesh, and
 * reads "nan", "inf" and "0x1p3" too, which no file of ours may hold. */
#ifndef RAYBOOK_SCENE_DECIMAL_H
#define RAYBOOK_SCENE_DECIMAL_H

/* Reads a number such as 12, -1.5, .5, 2. or +3e-7 that starts at text, which
 * ends in a zero byte. Stores the double nearest to it (infinity if it is too
 * large) and returns the place behind it; NULL if there is no number.
 *
 * Source: W. D. Clinger, "How to Read Floating Point Numbers Accurately",
 * PLDI 1990, section 4: digits below 2^53 and powers of ten up to 10^22 are
 * exact in a double, so that one operation rounds once, and correctly. */
const char *decimal_parse(const char *text, double *value);

#endif
