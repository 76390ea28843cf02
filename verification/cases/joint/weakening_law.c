/* A joint law of a shared library: friction that falls with slip.
 *
 *   tau_max = sigma (mu_r + (mu_p - mu_r) exp(-|path| / D))      parameters = [mu_p, mu_r, D]
 *
 * state is the path of slip so far, which only grows. Build: cc -O2 -shared -fPIC -ffp-contract=off -I HDEM/core/joint weakening_law.c -o weakening_law.so -lm
 */
#include "hdem_joint_law.h"

#include <math.h>

int hdem_joint_law_version(void)
{
    return HDEM_JOINT_LAW_VERSION;
}

void hdem_joint_law(const struct hdem_joint_points* p)
{
    const double peak = p->parameters[0], residual = p->parameters[1], distance = p->parameters[2];
    int i;
    for (i = 0; i < p->count; ++i)
    {
        const double trial = p->last_shear[i] - p->shear_stiffness * p->slide[i];
        const double normal = fmax(p->normal_stiffness * p->closure[i], 0.0);
        const double strength = normal * (residual + (peak - residual) * exp(-p->state[i] / distance));
        const double excess = fmax(fabs(trial) - strength, 0.0);
        p->normal[i] = normal;
        p->shear[i] = trial - copysign(excess, trial);
        p->strength[i] = strength;
        p->state[i] += excess / p->shear_stiffness;
    }
}
