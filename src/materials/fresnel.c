/* fresnel.c - see fresnel.h. */
#include "materials/fresnel.h"

#include <math.h>

#include "base/minmax.h"

//> fresnel.dielectric: Reflect off glass
float fresnel_dielectric(float cosine, float eta_beyond_over_here)
{
    float ratio = 1.0f / eta_beyond_over_here;
    /* Snell: 1 - ratio^2 (1 - cosine^2), arranged as in refraction.c. */
    float beyond2 =
        (1.0f - ratio) * (1.0f + ratio) + ratio * cosine * ratio * cosine;
    if (!(cosine > 0.0f && beyond2 > 0.0f))
        return 1.0f;
    float beyond = sqrtf(beyond2);
    float across = (ratio * cosine - beyond) / (ratio * cosine + beyond);
    float in_plane = (cosine - ratio * beyond) / (cosine + ratio * beyond);
    return 0.5f * (across * across + in_plane * in_plane);
}
//< fresnel.dielectric

//> fresnel.conductor: Reflect off metal
/* Born and Wolf's u2 and v2 (14.2, equation 8) are the real and imaginary part
 * of (eta + ik) times the cosine inside; only u and u2 + v2 are needed. */
float fresnel_conductor(float cosine, float eta, float k)
{
    if (!(cosine > 0.0f))
        return 1.0f;
    float cosine2 = cosine * cosine, sine2 = 1.0f - cosine2;
    float difference = eta * eta - k * k - sine2;
    float sum = hypotf(difference, 2.0f * eta * k); /* u^2 + v^2 */
    float u = sqrtf(float_max(0.0f, 0.5f * (sum + difference)));
    float mixed = 2.0f * cosine * u;
    float across = (sum + cosine2 - mixed) / (sum + cosine2 + mixed);
    float fixed = cosine2 * sum + sine2 * sine2;
    float in_plane = across * (fixed - mixed * sine2) / (fixed + mixed * sine2);
    /* Rounding may take an invisible metal, eta = 1 and k = 0, below 0. */
    return float_max(0.0f, 0.5f * (across + in_plane));
}
//< fresnel.conductor
