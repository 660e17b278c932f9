/* bench_commands.h - the commands of the program that measures: each is told
 * of at the top of its file, bench_NAME.c. */
#ifndef RAYBOOK_BENCH_COMMANDS_H
#define RAYBOOK_BENCH_COMMANDS_H

/* As main: argv[0] is the command's name; returns the exit code. */
int bench_cast(int argc, char *argv[]);
int bench_build(int argc, char *argv[]);
int bench_work(int argc, char *argv[]);
int bench_load(int argc, char *argv[]);
int bench_image(int argc, char *argv[]);

#endif
