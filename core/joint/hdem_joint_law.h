/* Joint laws in a shared library: what hdem asks of it. C and C++, version 1.
 *
 * In the case: [joint.NAME] with law = "file.so" and parameters = [...]. The library has two functions:
 *
 *   int  hdem_joint_law_version(void)                             returns HDEM_JOINT_LAW_VERSION
 *   void hdem_joint_law(const struct hdem_joint_points* points)   one cycle at some points of one joint
 *
 * The second is called for one to four points, by several threads at the same time. It must answer for each point by itself, from
 * what it is given and nothing else: no state of its own, no random numbers. Then the results of hdem do not depend on threads.
 *
 * Signs: compression is positive. The shear stress acts on the incident block along t; `slide` is that block's way along t, so a
 * negative slide raises the stress. Before slip: shear = last_shear - shear_stiffness * slide.
 *
 * hdem itself finds what follows: slip from the shear stress, heat, and the energy of the shear spring. It makes a point empty where
 * closure + opening <= 0. Example: verification/cases/joint/weakening_law.c
 */
#ifndef HDEM_JOINT_LAW_H
#define HDEM_JOINT_LAW_H

#define HDEM_JOINT_LAW_VERSION 1

#ifdef __cplusplus
extern "C"
{
#endif

    struct hdem_joint_points
    {
        int count;                /* of points; length of each array below */
        int parameter_count;      /* of the joint's `parameters` */
        const double* parameters; /* as in the case */
        double normal_stiffness;  /* K_N of the joint [Pa/m] */
        double shear_stiffness;   /* K_S [Pa/m] */

        /* Given. */
        const double* closure;     /* by which the joint is pressed, without its dilation [m] */
        const double* slide;       /* way of the incident block along t in this cycle [m] */
        const double* last_shear;  /* after the last cycle [Pa] */
        const double* last_normal; /* [Pa] */
        const double* slip;        /* plastic slip so far, signed as the shear stress [m] */

        /* Memory of the point, 0 at first: read it, and leave what it is after this cycle. */
        double* state;   /* of the law */
        double* second;  /* of the law */
        double* opening; /* dilation [m] */

        /* To be answered. */
        double* normal;   /* normal stress at closure + opening [Pa] */
        double* shear;    /* [Pa] */
        double* strength; /* greatest shear stress under the present normal stress [Pa] */

        /* May be answered; filled beforehand for a linear normal spring. */
        double* energy;         /* of the normal spring [J/m2]; left NaN: normal^2 / (2 K_N) */
        double* normal_tangent; /* d normal / d closure [Pa/m]; K_N beforehand */
    };

#ifdef __cplusplus
}
#endif
#endif
