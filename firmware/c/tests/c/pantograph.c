/* The torques of the pantograph do the work of the force at the handle, at every pose within its reach. */
#include "pantograph.h"

#include <math.h>
#include <stdio.h>

int main(void)
{
    static const float forces[3][2] = {{1.0f, 0.0f}, {0.0f, 1.0f}, {-0.6f, 0.8f}};
    int left, right, i, j, checked = 0;
    for (left = 0; left <= 20; left++)
        for (right = 0; right <= 20; right++)
            for (i = 0; i < 3; i++) {
                const float step = 1e-3f;
                const float angles[2] = {1.6f + 0.05f * (float)left, 0.5f + 0.05f * (float)right};
                float torques[2], ahead[2], behind[2];
                pantograph_torques(angles, forces[i], torques);
                if (torques[0] == 0.0f && torques[1] == 0.0f)
                    continue;
                for (j = 0; j < 2; j++) {
                    float more[2] = {angles[0], angles[1]}, less[2] = {angles[0], angles[1]}, work;
                    more[j] += step;
                    less[j] -= step;
                    if (!pantograph_handle(more, ahead) || !pantograph_handle(less, behind))
                        continue;
                    work = forces[i][0] * (ahead[0] - behind[0]) + forces[i][1] * (ahead[1] - behind[1]);
                    if (fabsf(work / (2.0f * step) - torques[j]) > 2e-4f) {
                        printf("%g %g: motor %d: %g, by work %g\n", (double)angles[0], (double)angles[1], j, (double)torques[j],
                               (double)(work / (2.0f * step)));
                        return 1;
                    }
                    checked++;
                }
            }
    return checked < 1000;
}
