/* todo.c - see todo.h. */
#include "base/todo.h"

#include <stdio.h>

void todo_warn(int *said, const char *assignment, const char *file, int line,
               const char *instead)
{
    int before;
#ifdef _OPENMP
#pragma omp atomic read
#endif
    before = *said;
    if (before)
        return;
#ifdef _OPENMP
#pragma omp atomic capture
#endif
    before = (*said)++;
    if (!before)
        fprintf(stderr, "assignment %s: not implemented yet, %s:%d: %s\n",
                assignment, file, line, instead);
}
