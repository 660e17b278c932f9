/* tev.c - see tev.h. */
#define _POSIX_C_SOURCE 200809L

#include "program/tev.h"

#include <netdb.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "base/memory.h"

enum { TEV_CREATE_IMAGE = 4, TEV_UPDATE_IMAGE = 6 };

/* A message under construction. Integers and floats are written as they lie
 * in memory: the machines that this program is built for are little-endian. */
struct message {
    char *bytes;
    size_t size, room;
};

static void put(struct message *m, const void *data, size_t size)
{
    if (m->size + size > m->room) {
        m->room = 2 * (m->size + size);
        m->bytes = mem_resize(m->bytes, m->room, 1);
    }
    memcpy(m->bytes + m->size, data, size);
    m->size += size;
}

static void put_int32(struct message *m, int32_t value)
{
    put(m, &value, sizeof value);
}

static void put_int64(struct message *m, int64_t value)
{
    put(m, &value, sizeof value);
}

static void put_string(struct message *m, const char *text)
{
    put(m, text, strlen(text) + 1);
}

/* Length (filled in when sent), type, "grab focus" off, the picture's name. */
static struct message begin(const struct tev *v, char type)
{
    struct message m = {NULL, 0, 0};
    const char no = 0;
    put_int32(&m, 0);
    put(&m, &type, 1);
    put(&m, &no, 1);
    put_string(&m, v->name);
    return m;
}

static void put_channel_names(struct message *m)
{
    put_int32(m, 3);
    put_string(m, "R");
    put_string(m, "G");
    put_string(m, "B");
}

static void send_all(struct tev *v, struct message *m)
{
    uint32_t length = (uint32_t)m->size;
    size_t sent = 0;
    memcpy(m->bytes, &length, sizeof length);
    while (v->connected && sent < m->size) {
        ssize_t n =
            send(v->socket, m->bytes + sent, m->size - sent, MSG_NOSIGNAL);
        if (n <= 0) {
            fprintf(stderr, "raybook: the tev viewer has gone away\n");
            tev_close(v);
        }
        sent += n > 0 ? (size_t)n : 0;
    }
    mem_free(m->bytes);
}

static void send_create(struct tev *v, const struct image *image)
{
    struct message m = begin(v, TEV_CREATE_IMAGE);
    put_int32(&m, image->width);
    put_int32(&m, image->height);
    put_channel_names(&m);
    send_all(v, &m);
    v->created = true;
}

static void send_update(struct tev *v, const struct image *image)
{
    size_t pixels = (size_t)image->width * (size_t)image->height;
    struct message m = begin(v, TEV_UPDATE_IMAGE);
    put_channel_names(&m);
    put_int32(&m, 0);
    put_int32(&m, 0);
    put_int32(&m, image->width);
    put_int32(&m, image->height);
    for (int i = 0; i < 3; i++)
        put_int64(&m, i); /* where the channel starts */
    for (int i = 0; i < 3; i++)
        put_int64(&m, 3); /* from one of its values to the next */
    put(&m, image->pixels, pixels * sizeof(rgb));
    send_all(v, &m);
}

void tev_send(struct tev *v, const struct image *image)
{
    if (v->connected && !v->created)
        send_create(v, image);
    if (v->connected)
        send_update(v, image);
}

static int connect_to(const char *host, const char *port)
{
    struct addrinfo hints, *found;
    int s = -1;
    memset(&hints, 0, sizeof hints);
    hints.ai_socktype = SOCK_STREAM;
    if (getaddrinfo(host, port, &hints, &found) != 0)
        return -1;
    for (struct addrinfo *a = found; a != NULL && s < 0; a = a->ai_next) {
        s = socket(a->ai_family, a->ai_socktype, a->ai_protocol);
        if (s >= 0 && connect(s, a->ai_addr, a->ai_addrlen) != 0) {
            close(s);
            s = -1;
        }
    }
    freeaddrinfo(found);
    return s;
}

bool tev_connect(struct tev *v, const char *address, const char *name,
                 struct error *err)
{
    char host[256];
    const char *colon = strrchr(address, ':');
    v->connected = false;
    v->name = name;
    v->created = false;
    if (colon == NULL || colon == address || colon[1] == '\0')
        return error_set(err, "--tev %s: expected HOST:PORT", address);
    snprintf(host, sizeof host, "%.*s", (int)(colon - address), address);
    v->socket = connect_to(host, colon + 1);
    v->connected = v->socket >= 0;
    return v->connected ||
           error_set(err, "--tev %s: no viewer answers there", address);
}

void tev_close(struct tev *v)
{
    if (v->connected)
        close(v->socket);
    v->connected = false;
}
