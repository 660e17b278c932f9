/* material.c - see material.h. */
#include "materials/material.h"

#include "materials/diffuse.h"
#include "materials/glass.h"
#include "materials/perfect_refraction.h"
#include "materials/rough_conductor.h"
#include "materials/surface_color.h"

bool material_is_specular(const struct material *m)
{
    return m->kind == MATERIAL_REFRACTION || m->kind == MATERIAL_GLASS;
}

rgb material_eval(const struct material *m, const struct surface *s,
                  vec3 outgoing, vec3 incoming)
{
    switch (m->kind) {
    case MATERIAL_DIFFUSE:
        return diffuse_eval(m, s, outgoing, incoming);
    case MATERIAL_ROUGH_CONDUCTOR:
        return rough_conductor_eval(m, s, outgoing, incoming);
    case MATERIAL_REFRACTION:
    case MATERIAL_GLASS:
        break;
    }
    return rgb_grey(0.0f);
}

bool material_sample(const struct material *m, const struct surface *s,
                     vec3 outgoing, const float random[3], struct scatter *out)
{
    switch (m->kind) {
    case MATERIAL_DIFFUSE:
        return diffuse_sample(m, s, outgoing, random, out);
    case MATERIAL_REFRACTION:
        return perfect_refraction_sample(m, s, outgoing, out);
    case MATERIAL_GLASS:
        return glass_sample(m, s, outgoing, random, out);
    case MATERIAL_ROUGH_CONDUCTOR:
        return rough_conductor_sample(m, s, outgoing, random, out);
    }
    return false;
}

float material_pdf(const struct material *m, const struct surface *s,
                   vec3 outgoing, vec3 incoming)
{
    switch (m->kind) {
    case MATERIAL_DIFFUSE:
        return diffuse_pdf(m, s, outgoing, incoming);
    case MATERIAL_ROUGH_CONDUCTOR:
        return rough_conductor_pdf(m, s, outgoing, incoming);
    case MATERIAL_REFRACTION:
    case MATERIAL_GLASS:
        break;
    }
    return 0.0f;
}

rgb material_albedo(const struct material *m, const struct surface *s)
{
    switch (m->kind) {
    case MATERIAL_DIFFUSE:
        return surface_color(m->albedo, s);
    case MATERIAL_ROUGH_CONDUCTOR:
        return rough_conductor_albedo(m, s);
    case MATERIAL_REFRACTION:
    case MATERIAL_GLASS:
        break;
    }
    return rgb_grey(1.0f);
}
