/* todo.h - what an unfinished exercise says of itself.
 *
 * A stub calls TODO_WARN once for each of its calls; only the first prints:
 *
 *   assignment 03 bvh: not implemented yet, src/accel/bvh.c:41: testing
 *   every triangle                                   (on one line)
 */
#ifndef RAYBOOK_BASE_TODO_H
#define RAYBOOK_BASE_TODO_H

/* Prints the message the first time that it is called with this *said, from
 * whichever thread. assignment is "03 bvh"; instead says what happens in
 * place of the real thing. */
void todo_warn(int *said, const char *assignment, const char *file, int line,
               const char *instead);

#define TODO_WARN(assignment, instead)                                         \
    do {                                                                       \
        static int said_;                                                      \
        todo_warn(&said_, assignment, __FILE__, __LINE__, instead);            \
    } while (0)

#endif
