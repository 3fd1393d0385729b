// The few programs that draw everything. Colours are sRGB bytes from end to end: nothing converts them.
import * as three from "three";

const kUnpacked = `
    vec3 unpacked(uint packed) {
        return vec3(packed & 255u, (packed >> 8) & 255u, (packed >> 16) & 255u) / 255.0;
    }`;

/// Faces. Each of their points has the colour of one corner, the one it belongs to most; so every colour on the
/// screen is one that was given, and means what the legend says.
export function fill_material(): three.ShaderMaterial {
    return new three.ShaderMaterial({
        glslVersion: three.GLSL3,
        uniforms: { shading: { value: true }, wire: { value: false }, wire_width: { value: 1 } },
        side: three.DoubleSide,
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 1,
        vertexShader: `
            in uvec3 corner_colours;
            flat out uvec3 colours;
            out vec3 corner;
            out vec3 seen;
            void main() {
                int i = gl_VertexID % 3;
                corner = vec3(i == 0, i == 1, i == 2);
                colours = corner_colours;
                vec4 place = modelViewMatrix * vec4(position, 1.0);
                seen = place.xyz;
                gl_Position = projectionMatrix * place;
            }`,
        fragmentShader: `
            uniform bool shading;
            uniform bool wire;
            uniform float wire_width;
            flat in uvec3 colours;
            in vec3 corner;
            in vec3 seen;
            out vec4 pixel;
            ${kUnpacked}
            void main() {
                uint mine = corner.x >= corner.y && corner.x >= corner.z ? colours.x
                    : corner.y >= corner.z ? colours.y : colours.z;
                vec3 rgb = unpacked(mine);
                if (wire) {
                    // In pixels: the distance to the nearest edge, and the size of the face. Small faces lose their
                    // lines, which would leave nothing of the colours.
                    vec3 a_pixel = fwidth(corner);
                    vec3 away = corner / a_pixel;
                    float nearest = min(away.x, min(away.y, away.z));
                    float size = 1.0 / max(a_pixel.x, max(a_pixel.y, a_pixel.z));
                    float line = 1.0 - smoothstep(wire_width / 2.0 - 0.5, wire_width / 2.0 + 0.5, nearest);
                    float contrast = dot(rgb, vec3(0.3, 0.59, 0.11)) > 0.45 ? 0.0 : 1.0;
                    rgb = mix(rgb, vec3(contrast), 0.75 * line * smoothstep(3.0, 12.0, size));
                }
                if (shading) {
                    vec3 normal = normalize(cross(dFdx(seen), dFdy(seen)));
                    float light = abs(dot(normal, normalize(vec3(-0.35, 0.5, 0.8))));
                    rgb *= (gl_FrontFacing ? 1.0 : 0.85) * (0.6 + 0.4 * light);
                }
                pixel = vec4(rgb, 1.0);
            }`,
    });
}

/// Segments of a width in pixels, as two triangles each, slightly before what they lie on.
export function band_material(colour: three.Color): three.ShaderMaterial {
    return new three.ShaderMaterial({
        glslVersion: three.GLSL3,
        uniforms: { colour: { value: colour }, width: { value: 2 }, size: { value: new three.Vector2(1, 1) } },
        side: three.DoubleSide,
        vertexShader: `
            in vec3 other;
            in float side;
            uniform float width;
            uniform vec2 size;
            const float kNearest = 1e-5;
            void main() {
                vec4 a = modelViewMatrix * vec4(position, 1.0);
                vec4 b = modelViewMatrix * vec4(other, 1.0);
                // What is behind the eye has no place on the screen: cut there.
                if (a.z > -kNearest && b.z < -kNearest) a = mix(b, a, (b.z + kNearest) / (b.z - a.z));
                if (b.z > -kNearest && a.z < -kNearest) b = mix(a, b, (a.z + kNearest) / (a.z - b.z));
                vec4 from = projectionMatrix * vec4(a.xyz * 0.999, 1.0);
                vec4 to = projectionMatrix * vec4(b.xyz * 0.999, 1.0);
                vec2 along = (to.xy / to.w - from.xy / from.w) * size;
                vec2 across = length(along) > 0.0 ? normalize(vec2(-along.y, along.x)) : vec2(0.0);
                from.xy += side * across * width / size * from.w;
                gl_Position = from;
            }`,
        fragmentShader: `
            uniform vec3 colour;
            out vec4 pixel;
            void main() { pixel = vec4(colour, 1.0); }`,
    });
}

/// Discs of a size in pixels in the vertex's colour.
export function disc_material(): three.ShaderMaterial {
    return new three.ShaderMaterial({
        glslVersion: three.GLSL3,
        uniforms: { diameter: { value: 7 } },
        vertexShader: `
            in uint own_colour;
            flat out uint colour;
            uniform float diameter;
            void main() {
                colour = own_colour;
                gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
                gl_PointSize = diameter;
            }`,
        fragmentShader: `
            flat in uint colour;
            out vec4 pixel;
            ${kUnpacked}
            void main() {
                if (length(gl_PointCoord - 0.5) > 0.5) discard;
                pixel = vec4(unpacked(colour), 1.0);
            }`,
    });
}

/// A ring of a size in pixels, white between black; what it is around stays to be seen.
export function ring_material(hidden: boolean): three.ShaderMaterial {
    return new three.ShaderMaterial({
        glslVersion: three.GLSL3,
        uniforms: { diameter: { value: 22 }, opacity: { value: hidden ? 0.35 : 1 } },
        transparent: true,
        depthTest: !hidden,
        depthWrite: false,
        vertexShader: `
            uniform float diameter;
            void main() {
                // Nearer to the eye on the same ray, so that the surface around the vertex does not cut it.
                vec4 place = modelViewMatrix * vec4(position, 1.0);
                gl_Position = projectionMatrix * vec4(0.98 * place.xyz, 1.0);
                gl_PointSize = diameter;
            }`,
        fragmentShader: `
            uniform float diameter;
            uniform float opacity;
            out vec4 pixel;
            void main() {
                float radius = length(gl_PointCoord - 0.5);
                float soft = 1.0 / diameter;
                float ring = smoothstep(0.25 - soft, 0.25, radius) * (1.0 - smoothstep(0.5 - soft, 0.5, radius));
                float white = smoothstep(0.31 - soft, 0.31, radius) * (1.0 - smoothstep(0.44 - soft, 0.44, radius));
                if (ring == 0.0) discard;
                pixel = vec4(vec3(white), ring * opacity);
            }`,
    });
}

/// Lines of one pixel. `hidden` ones are behind something, and faint.
export function line_material(colour: three.Color, hidden: boolean): three.LineBasicMaterial {
    const material = new three.LineBasicMaterial({
        transparent: hidden,
        opacity: hidden ? 0.25 : 1,
        depthWrite: !hidden,
        depthFunc: hidden ? three.GreaterDepth : three.LessEqualDepth,
    });
    // Given to the constructor it would be copied.
    material.color = colour;
    return material;
}
