/* fuzz_file.h - the fuzzer's bytes as a file, since our readers take paths. */
#ifndef RAYBOOK_FUZZ_FILE_H
#define RAYBOOK_FUZZ_FILE_H

#include <stddef.h>
#include <stdint.h>

/* Writes the bytes to the file of that name in this process's own folder,
 * which holds what else is needed (run.py and replay.c see to it): the current
 * one. Stops the program when that fails. Returns name. */
const char *fuzz_file(const char *name, const uint8_t *data, size_t size);

/* A reader that answers false must have said why, and one that answers true
 * must not: stops the program otherwise. */
void fuzz_check_message(int fine, const char *message);

/* Does fuzz_check_message tell of every answer? Only replay.c wants that. */
extern int fuzz_tells;

/* What each harness defines; always 0. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#endif
