/* half.h - 16-bit floating point numbers. */
#ifndef RAYBOOK_IMAGE_HALF_H
#define RAYBOOK_IMAGE_HALF_H

#include <stdint.h>

/* The value of an IEEE 754 binary16 number, given as its bits: exact. */
float half_to_float(uint16_t bits);

#endif
