/* decimal.c - see decimal.h. "Take" functions start at c and return the place
 * behind what they took. */
#include "scene/decimal.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

/* digits x 10^exponent; exact is false once digits would pass 2^53. */
struct decimal {
    uint64_t digits;
    int exponent;
    bool exact;
};

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* A run of digits; each adds step to the exponent. */
static const char *take_digits(const char *c, int step, struct decimal *d)
{
    const uint64_t largest = (UINT64_C(1) << 53) / 10 - 1;
    for (; is_digit(*c); c++) {
        d->exact = d->exact && d->digits <= largest;
        if (d->exact) {
            d->digits = 10 * d->digits + (uint64_t)(*c - '0');
            d->exponent += step;
        }
    }
    return c;
}

/* "e-12", or nothing; NULL if there is an "e" without digits. */
static const char *take_exponent(const char *c, struct decimal *d)
{
    if (*c != 'e' && *c != 'E')
        return c;
    bool negative = c[1] == '-';
    c += negative || c[1] == '+' ? 2 : 1;
    if (!is_digit(*c))
        return NULL;
    int exponent = 0;
    for (; is_digit(*c); c++)
        exponent = exponent < 9999 ? 10 * exponent + (*c - '0') : exponent;
    d->exponent += negative ? -exponent : exponent;
    return c;
}

/* A decimal without its sign; NULL if there is none. */
static const char *take_unsigned(const char *c, struct decimal *d)
{
    const char *whole = c;
    c = take_digits(c, 0, d);
    size_t count = (size_t)(c - whole);
    if (*c == '.') {
        const char *fraction = c + 1;
        c = take_digits(fraction, -1, d);
        count += (size_t)(c - fraction);
    }
    return count > 0 ? take_exponent(c, d) : NULL;
}

static double decimal_value(struct decimal d, const char *text)
{
    static const double powers[] = {
        1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
        1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    if (!d.exact || d.exponent < -22 || d.exponent > 22)
        return strtod(text, NULL);
    if (d.exponent < 0)
        return (double)d.digits / powers[-d.exponent];
    return (double)d.digits * powers[d.exponent];
}

const char *decimal_parse(const char *text, double *value)
{
    struct decimal d = {0, 0, true};
    bool negative = *text == '-';
    const char *start = text + (negative || *text == '+' ? 1 : 0);
    const char *end = take_unsigned(start, &d);
    if (end != NULL) {
        double magnitude = decimal_value(d, start);
        *value = negative ? -magnitude : magnitude;
    }
    return end;
}
