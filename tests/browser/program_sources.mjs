// A program in all languages for the test of the program's panel: ST and a chart as text, ladder and function blocks as PLCopen XML.

export const TEXT = `
TYPE
  Mode : (Idle, Filling, Full) := Idle;
END_TYPE

FUNCTION_BLOCK Smooth
  VAR_INPUT
    x : REAL;
  END_VAR
  VAR_OUTPUT
    y : REAL; // follows x
  END_VAR
  VAR
    weight : REAL := 0.25;
  END_VAR
  y := y + weight * (x - y);
END_FUNCTION_BLOCK

PROGRAM Mixer
  VAR_EXTERNAL
    Level : INT;
  END_VAR
  VAR
    smooth_level : Smooth;
    history : ARRAY[1..3] OF INT := [10, 20, 30];
    index : INT := 2;
    full : BOOL;
    picked : INT;
  END_VAR
  (* what the sensor says,
     without its noise *)
  smooth_level(x := INT_TO_REAL(Level));
  IF smooth_level.y > 40.0 THEN
    full := TRUE; // until it is drained
  ELSIF Level = 0 THEN
    full := FALSE;
  END_IF;
  picked := history[index];
END_PROGRAM

PROGRAM Sequence
  VAR_EXTERNAL
    Running : BOOL;
    Level : INT;
  END_VAR
  VAR
    pump : BOOL;
  END_VAR
  INITIAL_STEP Waiting:
  END_STEP
  STEP Pumping:
    pump(N);
    Fill(N);
  END_STEP
  TRANSITION begins FROM Waiting TO Pumping := Running;
  END_TRANSITION
  TRANSITION ends FROM Pumping TO Waiting := NOT Running OR Level >= 30000;
  END_TRANSITION
  ACTION Fill:
    Level := Level + 1;
  END_ACTION
END_PROGRAM

CONFIGURATION Plant
  VAR_GLOBAL
    Start : BOOL;
    Stop : BOOL;
    Running : BOOL;
    Level : INT;
    Late : BOOL;
    Sum : INT;
    High : BOOL;
  END_VAR
  RESOURCE Cpu ON Any
    TASK Cycle(INTERVAL := T#10ms, PRIORITY := 1);
    PROGRAM Chart WITH Cycle : Sequence;
    PROGRAM Rungs WITH Cycle : Ladder;
    PROGRAM Nets WITH Cycle : Blend;
    PROGRAM Main WITH Cycle : Mixer;
    PROGRAM Second WITH Cycle : Mixer;
  END_RESOURCE
END_CONFIGURATION
`;

const at = (element, id, x, y, inside, attributes = '') => `<${element} localId="${id}"${attributes}><position x="${x}" y="${y}"/>${inside}</${element}>`;
const from = (...ids) => `<connectionPointIn>${ids.map((id) => { const [one, pin] = String(id).split(':'); return `<connection refLocalId="${one}"${pin ? ` formalParameter="${pin}"` : ''}/>`; }).join('')}</connectionPointIn>`;
const rail = (id, y) => at('leftPowerRail', id, 20, y, '<connectionPointOut formalParameter=""/>');
const contact = (id, x, y, source, name, more = '') => at('contact', id, x, y, `${from(...source)}<connectionPointOut/><variable>${name}</variable>`, more);
const coil = (id, x, y, source, name, more = '') => at('coil', id, x, y, `${from(...source)}<connectionPointOut/><variable>${name}</variable>`, more);
const input = (id, x, y, text) => at('inVariable', id, x, y, `<connectionPointOut/><expression>${text}</expression>`, ' width="60" height="20"');
const output = (id, x, y, source, text) => at('outVariable', id, x, y, `${from(source)}<expression>${text}</expression>`, ' width="60" height="20"');
const pins = (list) => list.map(([pin, source, more = '']) => `<variable formalParameter="${pin}"${more}>${from(source)}</variable>`).join('');
const block = (id, x, y, type, inputs, outputs, instance = '') =>
  at('block', id, x, y, `<inputVariables>${pins(inputs)}</inputVariables><inOutVariables/><outputVariables>${outputs.map((pin) => `<variable formalParameter="${pin}"><connectionPointOut/></variable>`).join('')}</outputVariables>`, ` typeName="${type}"${instance ? ` instanceName="${instance}"` : ''} width="80" height="${30 + 20 * Math.max(inputs.length, outputs.length)}"`);
const variable = (name, type) => `<variable name="${name}"><type>${/^[A-Z]+$/.test(type) && type !== 'TON' ? `<${type}/>` : `<derived name="${type}"/>`}</type></variable>`;
const pou = (name, externals, locals, body) => `<pou name="${name}" pouType="program"><interface><localVars>${locals.map((v) => variable(...v)).join('')}</localVars><externalVars>${externals.map((v) => variable(...v)).join('')}</externalVars></interface><body>${body}</body></pou>`;
const ladder = `<LD>
${at('comment', 1, 20, 10, '<content><xhtml:p>Runs until somebody stops it</xhtml:p></content>', ' width="200" height="20"')}
${rail(2, 40)}${contact(3, 60, 40, [2], 'Start')}${contact(4, 60, 80, [2], 'Running')}${contact(5, 160, 40, [3, 4], 'Stop', ' negated="true"')}${coil(6, 400, 40, [5], 'Running')}
${rail(10, 200)}${contact(11, 60, 200, [10], 'Running')}${block(12, 160, 190, 'TON', [['IN', 11], ['PT', 13]], ['Q', 'ET'], 'patience')}${input(13, 60, 230, 'T#300ms')}${coil(14, 400, 200, ['12:Q'], 'Late', ' storage="set"')}
${rail(20, 300)}${contact(21, 60, 300, [20], 'Stop')}${contact(22, 160, 300, [21], 'Late', ' negated="true"')}${coil(23, 400, 300, [21], 'Late', ' storage="reset"')}
${rail(30, 400)}${contact(31, 60, 400, [30], 'Start', ' edge="rising"')}${coil(32, 400, 400, [31], 'began')}
${rail(40, 500)}${contact(41, 60, 500, [40], 'Running', ' negated="true"')}${contact(42, 160, 500, [41], 'Late')}${coil(43, 400, 500, [41], 'lamp')}${coil(44, 400, 540, [42], 'horn', ' negated="true"')}
</LD>`;
const blend = `<FBD>
${input(1, 20, 40, 'Level')}${input(2, 20, 80, '5')}${block(3, 140, 30, 'ADD', [['IN1', 1], ['IN2', 2]], ['OUT'])}${output(4, 460, 45, '3:OUT', 'Sum')}
${input(5, 20, 130, '30')}${block(6, 280, 90, 'GT', [['IN1', '3:OUT'], ['IN2', 5]], ['OUT'])}${input(7, 280, 170, 'Running')}${block(8, 420, 100, 'AND', [['IN1', '6:OUT'], ['IN2', 7, ' negated="false"']], ['OUT'])}${output(9, 560, 115, '8:OUT', 'High')}
${input(10, 20, 240, 'T#2s')}${block(11, 560, 200, 'TON', [['IN', '8:OUT'], ['PT', 10]], ['Q', 'ET'], 'delay')}${output(12, 700, 215, '11:Q', 'ready')}
</FBD>`;

const VARIABLES = (...names) => names.map((name) => [name, name === 'Level' || name === 'Sum' ? 'INT' : 'BOOL']);

export const DRAWN = `<?xml version="1.0" encoding="utf-8"?>
<project xmlns="http://www.plcopen.org/xml/tc6_0201" xmlns:xhtml="http://www.w3.org/1999/xhtml">
<fileHeader companyName="test" productName="test" productVersion="1" creationDateTime="2026-11-22T13:00:00"/>
<contentHeader name="logic"><coordinateInfo><fbd><scaling x="0" y="0"/></fbd><ld><scaling x="0" y="0"/></ld><sfc><scaling x="0" y="0"/></sfc></coordinateInfo></contentHeader>
<types><dataTypes/><pous>
${pou('Ladder', VARIABLES('Start', 'Stop', 'Running', 'Late'), [['patience', 'TON'], ['began', 'BOOL'], ['lamp', 'BOOL'], ['horn', 'BOOL']], ladder)}
${pou('Blend', VARIABLES('Level', 'Sum', 'High', 'Running'), [['delay', 'TON'], ['ready', 'BOOL']], blend)}
</pous></types><instances><configurations/></instances></project>`;
