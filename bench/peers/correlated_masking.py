"""A BSDF for Mitsuba that changes one thing about a GGX material: how masking and shadowing combine.

Mitsuba multiplies Smith's two terms, G = G1(wi) G1(wo). Phalanx takes the height-correlated form,
G = 1 / (1 + L(wi) + L(wo)) (Heitz, JCGT 3:2, 2014, eq. 99). Both are in use; the ratio of the two is
known in closed form, so this wrapper multiplies by it and leaves everything else to Mitsuba.
"""
import drjit as dr
import mitsuba as mi


def smith_lambda(w, alpha_u, alpha_v):
    tan2 = (dr.square(alpha_u * w.x) + dr.square(alpha_v * w.y)) / dr.square(w.z)
    return 0.5 * (dr.sqrt(1 + tan2) - 1)


def correlated_over_separable(wi, wo, alpha_u, alpha_v):
    """(1 + a) (1 + b) / (1 + a + b) >= 1 for any two directions not along the surface."""
    a, b = smith_lambda(wi, alpha_u, alpha_v), smith_lambda(wo, alpha_u, alpha_v)
    # By the larger one, lest the product overflow at grazing angles.
    low, high = dr.minimum(a, b), dr.maximum(a, b)
    return dr.select(wi.z * wo.z != 0, (1 + low) / (1 + low / (1 + high)), 0)


class CorrelatedMasking(mi.BSDF):
    """alpha_u, alpha_v: widths of the nested material's distribution."""

    def __init__(self, props):
        mi.BSDF.__init__(self, props)
        self.nested = props["nested"]
        self.alpha_u, self.alpha_v = props["alpha_u"], props["alpha_v"]
        self.m_components = [self.nested.flags(i) for i in range(self.nested.component_count())]
        self.m_flags = self.nested.flags()

    def ratio(self, si, wo):
        return correlated_over_separable(si.wi, wo, self.alpha_u, self.alpha_v)

    def sample(self, ctx, si, sample1, sample2, active=True):
        bs, weight = self.nested.sample(ctx, si, sample1, sample2, active)
        return bs, weight * self.ratio(si, bs.wo)

    def eval(self, ctx, si, wo, active=True):
        return self.nested.eval(ctx, si, wo, active) * self.ratio(si, wo)

    def pdf(self, ctx, si, wo, active=True):
        return self.nested.pdf(ctx, si, wo, active)

    def eval_pdf(self, ctx, si, wo, active=True):
        value, pdf = self.nested.eval_pdf(ctx, si, wo, active)
        return value * self.ratio(si, wo), pdf

    def to_string(self):
        return f"CorrelatedMasking[{self.nested}]"
