// A scene that carom-web has described, made in a peer: `make` gives { step, height }. Materials are one for all, contacts as each engine has them.

async function box2d(scene)
{
    const b2 = await (await import('box2d3-wasm')).default();
    const vec = ([x, y]) => { const v = new b2.b2Vec2(); v.x = x; v.y = y; return v; };
    const def = b2.b2DefaultWorldDef();
    def.gravity = vec(scene.gravity);
    def.enableSleep = false;
    const world = b2.b2CreateWorld(def);
    const shapes = {
        disc: (body, d, s) => {
            const circle = new b2.b2Circle();
            circle.center = vec(s.center);
            circle.radius = s.radius;
            b2.b2CreateCircleShape(body, d, circle);
        },
        capsule: (body, d, s) => {
            const capsule = new b2.b2Capsule();
            capsule.center1 = vec(s.a);
            capsule.center2 = vec(s.b);
            capsule.radius = s.radius;
            b2.b2CreateCapsuleShape(body, d, capsule);
        },
        polygon: (body, d, s) => b2.b2CreatePolygonShape(body, d, b2.b2MakePolygon(b2.b2ComputeHull(s.corners.map(vec)), 0)),
    };
    const make = (b) => {
        const d = b2.b2DefaultBodyDef();
        d.type = b.dynamic ? b2.b2BodyType.b2_dynamicBody : b2.b2BodyType.b2_staticBody;
        d.position = vec(b.position);
        d.rotation = b2.b2MakeRot(b.angle);
        const body = b2.b2CreateBody(world, d);
        for (const s of b.shapes) {
            const shape = b2.b2DefaultShapeDef();
            shape.density = s.density;
            shape.material.friction = s.friction;
            shape.material.restitution = s.restitution;
            shapes[s.kind](body, shape, s);
        }
        return body;
    };
    const bodies = scene.bodies.map(make);
    const ground = make({ dynamic: false, position: [0, 0], angle: 0, shapes: [] });
    for (const h of scene.hinges) {
        const joint = b2.b2DefaultRevoluteJointDef();
        const party = (i) => (i < 0 ? ground : bodies[i]);
        const at = (i) => (i < 0 ? h.anchor : [h.anchor[0] - scene.bodies[i].position[0], h.anchor[1] - scene.bodies[i].position[1]]);
        joint.base.bodyIdA = party(h.a);
        joint.base.bodyIdB = party(h.b);
        joint.base.localFrameA.p = vec(at(h.a));
        joint.base.localFrameB.p = vec(at(h.b));
        joint.enableMotor = h.torque > 0;
        joint.motorSpeed = h.speed;
        joint.maxMotorTorque = h.torque;
        b2.b2CreateRevoluteJoint(world, joint);
    }
    return {
        step: () => b2.b2World_Step(world, scene.h, 4),
        height: () => bodies.reduce((sum, b) => sum + b2.b2Body_GetPosition(b).y, 0) / bodies.length,
    };
}

async function rapier(scene)
{
    const R = (await import('@dimforge/rapier2d-simd-compat')).default;
    await R.init();
    const world = new R.World({ x: scene.gravity[0], y: scene.gravity[1] });
    world.timestep = scene.h;
    const flat = (points) => new Float32Array(points.flat());
    const between = (p, q) => [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2];
    const shapes = {
        disc: (s) => R.ColliderDesc.ball(s.radius).setTranslation(...s.center),
        capsule: (s) => { // along y of its own frame
            const [x, y] = [s.b[0] - s.a[0], s.b[1] - s.a[1]];
            return R.ColliderDesc.capsule(Math.hypot(x, y) / 2, s.radius).setTranslation(...between(s.a, s.b)).setRotation(Math.atan2(-x, y));
        },
        polygon: (s) => {
            const xs = [...new Set(s.corners.map(([x]) => x))], ys = [...new Set(s.corners.map(([, y]) => y))];
            if (s.corners.length !== 4 || xs.length !== 2 || ys.length !== 2)
                return R.ColliderDesc.convexHull(flat(s.corners));
            return R.ColliderDesc.cuboid(Math.abs(xs[1] - xs[0]) / 2, Math.abs(ys[1] - ys[0]) / 2).setTranslation((xs[0] + xs[1]) / 2, (ys[0] + ys[1]) / 2);
        },
    };
    const make = (b) => {
        const desc = b.dynamic ? R.RigidBodyDesc.dynamic() : R.RigidBodyDesc.fixed();
        const body = world.createRigidBody(desc.setTranslation(...b.position).setRotation(b.angle).setCanSleep(false));
        for (const s of b.shapes)
            world.createCollider(shapes[s.kind](s).setDensity(s.density).setFriction(s.friction).setRestitution(s.restitution), body);
        return body;
    };
    const bodies = scene.bodies.map(make);
    const ground = make({ dynamic: false, position: [0, 0], angle: 0, shapes: [] });
    for (const h of scene.hinges) {
        const party = (i) => (i < 0 ? ground : bodies[i]);
        const at = (i) => ({ x: h.anchor[0] - (i < 0 ? 0 : scene.bodies[i].position[0]), y: h.anchor[1] - (i < 0 ? 0 : scene.bodies[i].position[1]) });
        const joint = world.createImpulseJoint(R.JointData.revolute(at(h.a), at(h.b)), party(h.a), party(h.b), true);
        joint.configureMotorVelocity(h.speed, h.torque);
    }
    return {
        step: () => world.step(),
        height: () => bodies.reduce((sum, b) => sum + b.translation().y, 0) / bodies.length,
    };
}

export const peers = { box2d, rapier };
