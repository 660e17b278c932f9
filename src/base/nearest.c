/* nearest.c - see nearest.h. */
#include "base/nearest.h"

#include <ctype.h>
#include <stddef.h>
#include <string.h>

enum { LONGEST = 63 }; /* longer words are not compared */

static int least(int a, int b, int c)
{
    int ab = a < b ? a : b;
    return ab < c ? ab : c;
}

static int letters_differ(char a, char b)
{
    return tolower((unsigned char)a) != tolower((unsigned char)b);
}

/* Edits (insert, remove, replace a letter) between two words, by V.
 * Levenshtein's recurrence, one row of the table at a time. */
static int edit_distance(const char *a, const char *b)
{
    int row[LONGEST + 1];
    int width = (int)strlen(b);
    for (int j = 0; j <= width; j++)
        row[j] = j;
    for (int i = 1; a[i - 1] != '\0'; i++) {
        int diagonal = row[0];
        row[0] = i;
        for (int j = 1; j <= width; j++) {
            int above = row[j];
            row[j] = least(above + 1, row[j - 1] + 1,
                           diagonal + letters_differ(a[i - 1], b[j - 1]));
            diagonal = above;
        }
    }
    return row[width];
}

const char *nearest_name(const char *text, const char *const names[])
{
    const char *nearest = NULL;
    int length = (int)strlen(text);
    int limit = 1 + length / 3;
    if (length > LONGEST)
        return NULL;
    for (int i = 0; names[i] != NULL; i++) {
        if (strlen(names[i]) > LONGEST)
            continue;
        int distance = edit_distance(text, names[i]);
        if (distance <= limit && distance < length) {
            nearest = names[i];
            limit = distance - 1;
        }
    }
    return nearest;
}
