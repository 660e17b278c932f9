/* obj_reader.h - reads a triangle mesh from a Wavefront OBJ file.
 *
 * Read: v (further numbers on the line, a weight or a colour, are checked
 * and dropped), vt, vn, and f with any number of corners, written v, v/vt,
 * v//vn or v/vt/vn with indices from 1, or negative ones that count back from
 * the latest. A line ending in \ goes on in the next; CR LF is fine; # starts
 * a comment. Lines with another keyword (o g s usemtl mtllib l p ...) are
 * passed over.
 *
 * Source: Wavefront Technologies, "Advanced Visualizer Manual", appendix B1,
 * "Object Files (.obj)". */
#ifndef RAYBOOK_SCENE_OBJ_READER_H
#define RAYBOOK_SCENE_OBJ_READER_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "shapes/mesh.h"

/* Reads path into *out, which the caller then owns: mesh_free. A polygon
 * of n corners becomes the n - 2 triangles of a fan about its first corner.
 *
 * The mesh has one index a corner: the file's separate indices for position,
 * texture coordinate and normal are unified, so a position that is used with
 * two texture coordinates becomes two vertices.
 *
 * - Every number is finite; every index is below vertex_count;
 *   triangle_count > 0. Triangles without area may occur.
 * - normals are as in the file: perhaps not of length one, perhaps zero.
 * - uvs have v = 0 at the image's top row: v here is 1 - v in the file.
 * - normals is NULL if any corner of any face comes without one, and likewise
 *   uvs: an attribute is there for all vertices or for none.
 *
 * On a fault returns false with err filled and *out all zero. The message
 * names the place, its line and column counted from 1 in bytes:
 *
 *     box.obj:12:7: vertex index 9 is out of range: the file has 8 vertices
 *     so far
 *
 * Faults: a file that cannot be read, is 4 GiB or larger, holds a zero byte,
 * or has no face; a line whose keyword does not start with a letter; a
 * missing, malformed or infinite number; an index of zero or out of range; a
 * face with fewer than three corners. */
bool obj_read(const char *path, struct mesh *out, struct error *err);

#endif
