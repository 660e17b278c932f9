/* version.h - which program this is; the build says it. */
#ifndef RAYBOOK_PROGRAM_VERSION_H
#define RAYBOOK_PROGRAM_VERSION_H

#ifndef RAYBOOK_VERSION
#define RAYBOOK_VERSION "unknown"
#endif
#ifndef RAYBOOK_VARIANT
#define RAYBOOK_VARIANT "reference"
#endif

#endif
