/* tev.h - sending the picture to the image viewer tev.
 *
 * The protocol is the one of tev's README, "Over the network": each message is
 * its length in bytes (itself included), a type, and the type's fields, all
 * little-endian. */
#ifndef RAYBOOK_PROGRAM_TEV_H
#define RAYBOOK_PROGRAM_TEV_H

#include <stdbool.h>

#include "base/error.h"
#include "image/image.h"

/* All zero: there is no viewer, and sending does nothing. */
struct tev {
    bool connected;
    int socket;
    const char *name; /* of the picture, as the viewer shows it */
    bool created;
};

/* Connects to HOST:PORT; false: bad address or nobody there. */
bool tev_connect(struct tev *v, const char *address, const char *name,
                 struct error *err);

/* Creates the picture the first time, then replaces its pixels. If the viewer
 * has gone away, says so once and sends no more. */
void tev_send(struct tev *v, const struct image *image);

void tev_close(struct tev *v);

#endif
