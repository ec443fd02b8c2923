"""A BSDF for Mitsuba: its rough plastic, with the base that Phalanx has under a rough coat.

Both reflect the same light off the coat. Mitsuba's "roughplastic" takes what single scattering passes
through the coat as what reaches the base, so the light that bounces between microfacets is lost on the
way in and on the way out. Phalanx lets all that is not reflected enter, T = 1 - E, and a white base
gives it all back: f = albedo T(wi) T(wo) / (pi eta^2 (1 - albedo (1 - T_average / eta^2))). E is
integrated here by Mitsuba's own functions, not read from the program's tables.
"""
import drjit as dr
import mitsuba as mi
import numpy as np

from correlated_masking import correlated_over_separable, smith_lambda

NUM_COSINES = 256   # of E's table, at squares of equal steps
NUM_NORMALS = 128   # of each of two coordinates, for every cosine


def coat_albedo(alpha, eta):
    """E at cosines (i / (NUM_COSINES - 1))^2, and its average over the hemisphere."""
    x = np.linspace(0, 1, NUM_COSINES)
    cosine = np.maximum(x * x, 1e-6)
    u = (np.arange(NUM_NORMALS) + 0.5) / NUM_NORMALS
    c, u1, u2 = (mi.Float(a.ravel().astype(np.float32)) for a in np.meshgrid(cosine, u, u, indexing="ij"))
    wi = mi.Vector3f(dr.safe_sqrt(1 - c * c), 0, c)
    distribution = mi.MicrofacetDistribution(mi.MicrofacetType.GGX, alpha, True)
    m, _ = distribution.sample(wi, mi.Point2f(u1, u2))
    wo = mi.reflect(wi, m)
    reflectance = mi.fresnel(dr.dot(wi, m), eta)[0]
    a, b = smith_lambda(wi, alpha, alpha), smith_lambda(wo, alpha, alpha)
    value = dr.select(wo.z > 0, reflectance * (1 + a) / (1 + a + b), 0)
    albedo = np.array(value, dtype=np.float64).reshape(NUM_COSINES, -1).mean(axis=1)
    return albedo, float(np.trapezoid(2 * cosine * albedo, cosine))


class ConservingCoat(mi.BSDF):
    """nested: roughplastic. reflectance: texture of the base. alpha, eta: of the coat."""

    def __init__(self, props):
        mi.BSDF.__init__(self, props)
        self.nested, self.reflectance = props["nested"], props.get_texture("reflectance")
        self.alpha, self.inv_eta2 = props["alpha"], 1 / props["eta"] ** 2
        albedo, average = coat_albedo(self.alpha, props["eta"])
        self.entered = mi.Float((1 - albedo).astype(np.float32))
        self.leaves = (1 - average) * self.inv_eta2
        self.m_components = [self.nested.flags(i) for i in range(self.nested.component_count())]
        self.m_flags = self.nested.flags()

    def entering(self, cosine):
        x = dr.safe_sqrt(cosine) * (NUM_COSINES - 1)
        i = dr.clip(mi.UInt32(x), 0, NUM_COSINES - 2)
        a, b = dr.gather(mi.Float, self.entered, i), dr.gather(mi.Float, self.entered, i + 1)
        return a + (b - a) * (x - mi.Float(i))

    def eval(self, ctx, si, wo, active=True):
        glossy = mi.BSDFContext(ctx.mode)
        glossy.type_mask = mi.BSDFFlags.Glossy
        coat = self.nested.eval(glossy, si, wo, active)
        coat *= correlated_over_separable(si.wi, wo, self.alpha, self.alpha)
        albedo = self.reflectance.eval(si, active)
        base = albedo * self.inv_eta2 / (1 - albedo * (1 - self.leaves)) * dr.inv_pi
        base *= self.entering(si.wi.z) * self.entering(wo.z) * wo.z
        return coat + dr.select((si.wi.z > 0) & (wo.z > 0), base, 0)

    def sample(self, ctx, si, sample1, sample2, active=True):
        bs, _ = self.nested.sample(ctx, si, sample1, sample2, active)
        value = self.eval(ctx, si, bs.wo, active)
        return bs, dr.select(bs.pdf > 0, value / bs.pdf, 0)

    def pdf(self, ctx, si, wo, active=True):
        return self.nested.pdf(ctx, si, wo, active)

    def eval_pdf(self, ctx, si, wo, active=True):
        return self.eval(ctx, si, wo, active), self.pdf(ctx, si, wo, active)

    def to_string(self):
        return f"ConservingCoat[{self.nested}]"
