/* bench_clock.h - three clocks, in seconds since no particular moment. */
#ifndef RAYBOOK_BENCH_CLOCK_H
#define RAYBOOK_BENCH_CLOCK_H

double clock_wall(void);

/* Processor time of this thread, or of all threads of the process: what others
 * do on the machine does not count. */
double clock_thread(void);
double clock_process(void);

#endif
